//! Closed curves and segment sets: arc length, distances, held spans, crossings.
//!
//! Pure geometry in the plane, in millimetres; it knows nothing of layers or clay. The support rule of the
//! paper (Sec. 3.2, Eq. 1) rests on [`held_spans`], which gives in closed form what the paper samples.
//!
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod capsule;
mod closed_curve;
mod error;
mod grid;
mod held_spans;
mod point_index;
mod segment;
mod segment_index;
mod self_crossings;

pub use capsule::SegmentPart;
pub use closed_curve::{ClosedCurve, NearestOnCurve, OnCurve};
pub use error::CurveError;
pub use glam::DVec2;
pub use grid::on_grid;
pub use held_spans::{ArcSpan, gaps, held_spans};
pub use point_index::PointIndex;
pub use segment::{NearestOnSegment, Segment};
pub use segment_index::{NearestSegment, SegmentIndex};
pub use self_crossings::{Crossing, CrossingKind, self_crossings};
