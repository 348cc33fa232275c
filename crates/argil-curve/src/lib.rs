//! Closed curves and segment sets: arc length, distances, held spans, crossings.
//!
//! Pure geometry in the plane, in millimetres; it knows nothing of layers or clay. The support rule of the
//! paper (Sec. 3.2, Eq. 1) rests on [`held_spans`], which gives in closed form what the paper samples.
//!
#![doc = include_str!("../README.md")]
//!
//! # Held spans
//!
#![doc = include_str!("../pictures/held-spans.svg")]
//!
//! A curve above another one: terracotta is held, since it lies within the band about the curve below; blue are the gaps.
#![forbid(unsafe_code)]

mod capsule;
mod closed_curve;
mod error;
#[cfg(feature = "geo")]
mod geo;
mod grid;
mod held_spans;
mod point_index;
mod segment;
mod segment_index;
mod self_crossings;
mod simplification;

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
pub use simplification::{rounded, simplified, without_needles};
