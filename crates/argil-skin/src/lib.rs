#![doc = include_str!("../README.md")]
//!
//! # How it is built
//! 1. *Zones*: what of a layer's outline is open above or below, found by subtracting the neighbours' outlines, and the
//!    layers behind it; the lowest layers whole.
//! 2. *Loops*: the room that the walls leave in a zone is filled ([`argil_fill`]). The fill is a loop inside of the walls as any other.
//! 3. *Stripes*, where sparse fill is asked for: loops round every second stripe of what is left, in the same places on every layer.
//! 4. *Bumps*: where the layer above needs a place that lies between two lanes, the nearest lane gives way.
//!
//! Lengths are millimetres. The same input gives the same bytes.
#![forbid(unsafe_code)]

mod apart;
mod beneath;
mod bump;
mod model_loop;
mod offset;
mod options;
mod section;
mod stripes;
mod zone;

pub use argil_curve::DVec2;
pub use argil_fill::{BareDisc, FillError};
pub use beneath::beneath;
pub use bump::{Bumps, bumped};
pub use model_loop::ModelLoop;
pub use options::SkinOptions;
pub use section::{Filled, Section};
pub use stripes::Stripes;
pub use zone::zones;
