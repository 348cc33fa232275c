//! Which spans of a deposition path hang in the air, and the fewest points that hold them.
//!
//! Sec. 3.2 and Eq. 1 of the paper, with the criterion made continuous: the paper's samples let gaps of up to
//! twice its own limit pass.
//!
#![doc = include_str!("../README.md")]
//!
//! # In a picture
//!
#![doc = include_str!("../pictures/support-points.svg")]
//!
//! The right half of the path has no wall below it. The points hold it, and a strand may pass anywhere in their discs.
#![forbid(unsafe_code)]

mod coverage;
mod criterion;
mod hairpin;
mod place_supports;
mod placement;
mod run;
mod sharing;
mod stride;

pub use argil_curve::{ArcSpan, ClosedCurve, DVec2, Segment, SegmentIndex};
pub use criterion::{Criterion, unsupported_spans};
pub use place_supports::{SupportPoint, place_supports};
pub use placement::Placement;
pub use stride::stride_supports;
