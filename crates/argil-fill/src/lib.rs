#![doc = include_str!("../README.md")]
//!
//! # In a picture
//!
#![doc = include_str!("../pictures/fill.svg")]
//!
//! The plate of the example: its wall is terracotta, further rings are ochre, joints blue. It is one closed curve.
//!
//! # How it is built
//! The method is the ring merge; full connected Fermat spirals reach continuity by a tree of joints, too (Zhao et al. 2016,
//! <https://doi.org/10.1145/2897824.2925958>).
//!
//! 1. *Rings*: the boundary of the region inset by (k + ½) w, level by level.
//! 2. *Residue*: what the beads of a level leave bare gets a loop there and back, if it is wide enough.
//!    Chains of rings without a branch become double spirals on request, each of which is one ring then.
//! 3. *Joints*: for neighbouring rings two legs, scored by how straight and parallel they lie; Kruskal's tree of them.
//! 4. *Trace*: arcs and legs by turns are one closed curve for each tree.
//! 5. *Mending*: the nearest strand makes a detour into each disc that is still bare; a wall gives no more of itself than to a joint.
//! 6. *Flow*, on request: each stretch lays the clay of what is nearest to it.
//!
//! Walls are offsets of polygons. All other distances are those of a grid of points a fifth of a bead apart that know the segment nearest to
//! them: rings and residue loops are lines of equal distance on it, drawn with their corners, and what is bare is read off it.
//!
//! Lengths are millimetres. The same input gives the same bytes.
#![forbid(unsafe_code)]

mod bare;
mod contour;
mod curve;
mod detour;
mod error;
mod fill;
mod flow;
mod joint;
mod merge;
mod nearest;
mod offset;
mod options;
mod plot;
mod residue;
mod ring;
mod rings;
mod spiral;
mod trace;
mod tree;

pub use argil_curve::DVec2;
pub use bare::BareDisc;
pub use curve::{Bead, FillCurve};
pub use error::FillError;
pub use fill::{Figures, Fill, fill};
pub use joint::Joint;
pub use merge::{Merged, merge};
pub use options::{FillOptions, FillPattern};
pub use ring::Ring;
