//! Curves and segments come back from `geo-types` as they were.
#![cfg(feature = "geo")]
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking, also outside of its own function")]

use argil_curve::{ClosedCurve, CurveError, DVec2, Segment};
use geo_types::{Line, LineString, Polygon};
use proptest::prelude::*;

proptest! {
    #[test]
    fn there_and_back_changes_nothing(corners in prop::collection::vec((-1e6..1e6f64, -1e6..1e6f64), 2..40)) {
        let Ok(curve) = ClosedCurve::new(corners.into_iter().map(DVec2::from).collect()) else { return Ok(()) };
        let line = LineString::from(&curve);
        prop_assert_eq!(line.0.len(), curve.points().len() + 1);
        prop_assert_eq!(&ClosedCurve::try_from(&line).unwrap(), &curve);
        let polygon = Polygon::from(&curve);
        prop_assert_eq!(&ClosedCurve::try_from(polygon.exterior()).unwrap(), &curve);
        for segment in curve.segments() {
            prop_assert_eq!(Segment::from(Line::from(segment)), segment);
        }
    }
}

#[test]
fn a_line_that_is_no_curve_is_refused() {
    let point = LineString::from(vec![(1.0, 1.0), (1.0, 1.0)]);
    assert_eq!(ClosedCurve::try_from(&point), Err(CurveError::TooFewPoints { distinct: 1 }));
}
