//! Paths pulled taut: as short as the exact rule of support allows.
//!
//! A smoothed path keeps its points inside discs, which is a simple promise to keep while all of them move at once, and
//! a cautious one: a strand may lie `ε_across` beside the one above where a disc grants two thirds of it, and may hang
//! free over `ε_along` wherever it likes. Here the points move one at a time, for as long as the exact rule still holds.
//! Strand that is not there need not be held by the layers below.
//!
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod clearing;
mod holding;
mod options;
mod pulling;

pub use argil_curve::{ClosedCurve, DVec2, SegmentIndex};
pub use options::TautOptions;
pub use pulling::{SlackPath, pulled_taut};
