//! One start point a layer, so that the strand climbs in short steps that cross nothing.
//!
//! Sec. 3.3 of the paper has each layer start at a point that the layer below contains, and does not say which.
//!
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod candidates;
mod chain;
mod error;
mod nearest;
mod plan;
mod step;

pub use argil_curve::{ClosedCurve, DVec2, Segment};
pub use chain::{SeamSettings, seam_chain, seam_chain_among};
pub use error::SeamError;
pub use nearest::nearest_chain;
pub use step::{is_clear, shut_directions};
