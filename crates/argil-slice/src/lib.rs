#![doc = include_str!("../README.md")]
//!
//! # How it is built
//! A sweep over the triangles cuts the mesh at the middle of each layer and links the pieces along shared mesh
//! edges; the contours are filled by the non-zero rule; each
//! outline is inset for its walls, opened and simplified; where that leaves part of it bare, the first wall follows the
//! chordal axis there and back; the loops are rounded to the output grid and
//! only then checked, since rounding is what breaks slivers. What cannot be printed as it is becomes a
//! [`Loss`] with its layer and place. Polygons are `geo-types`, paths `glam::DVec2`.
//!
//! Lengths are millimetres, z is up; loops round solid run counter-clockwise, round holes clockwise.
#![forbid(unsafe_code)]

mod centring;
mod chain;
mod chordal_axis;
mod containment;
mod error;
mod fit;
mod further;
mod gaps;
mod layer;
mod loops;
mod mitre;
mod openings;
mod pockets;
mod prisms;
mod pruning;
mod region;
#[cfg(feature = "serde")]
mod rings;
mod section;
mod settings;
mod sheet;
mod slender;
mod slicing;
mod soundness;
mod spine;
mod stack;
mod thin;
mod wall;
mod winding;

pub use argil_mesh as mesh;
pub use error::SliceError;
pub use glam::DVec2;
pub use layer::{Layer, Loss, WallLoop, outer_walls};
pub use openings::check_closed;
pub use prisms::prisms;
pub use settings::SliceSettings;
pub use slicing::{slice, slice_while};
pub use stack::stacked;
