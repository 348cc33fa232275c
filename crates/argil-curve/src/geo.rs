//! Curves and segments as those of `geo-types`.

use geo_types::{Coord, Line, LineString, Polygon};
use glam::DVec2;

use crate::{ClosedCurve, CurveError, Segment};

fn coord(p: DVec2) -> Coord<f64> {
    Coord { x: p.x, y: p.y }
}

fn point(c: Coord<f64>) -> DVec2 {
    DVec2::new(c.x, c.y)
}

impl From<Segment> for Line<f64> {
    fn from(segment: Segment) -> Self {
        Line::new(coord(segment.start), coord(segment.end))
    }
}

impl From<Line<f64>> for Segment {
    fn from(line: Line<f64>) -> Self {
        Segment::new(point(line.start), point(line.end))
    }
}

impl From<&ClosedCurve> for LineString<f64> {
    /// The curve as a closed line, its first point repeated at the end.
    ///
    /// # Example
    /// ```
    /// use argil_curve::{ClosedCurve, CurveError, DVec2};
    /// use geo_types::LineString;
    /// let curve = ClosedCurve::new([(0.0, 0.0), (4.0, 0.0), (0.0, 3.0)].map(DVec2::from).to_vec())?;
    /// let line = LineString::from(&curve);
    /// assert!(line.is_closed());
    /// assert_eq!(ClosedCurve::try_from(&line)?, curve);
    /// # Ok::<(), CurveError>(())
    /// ```
    fn from(curve: &ClosedCurve) -> Self {
        curve.points().iter().chain(curve.points().first()).copied().map(coord).collect()
    }
}

impl From<&ClosedCurve> for Polygon<f64> {
    /// What the curve encloses. Like all polygons of `geo-types` it is only as simple as its boundary.
    fn from(curve: &ClosedCurve) -> Self {
        Polygon::new(curve.into(), Vec::new())
    }
}

impl TryFrom<&LineString<f64>> for ClosedCurve {
    type Error = CurveError;

    /// The line, closed if it is not.
    fn try_from(line: &LineString<f64>) -> Result<Self, CurveError> {
        ClosedCurve::new(line.coords().copied().map(point).collect())
    }
}
