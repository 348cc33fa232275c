//! Closed polylines measured by arc length.

use crate::segment::side;
use crate::{CurveError, Segment};
use glam::DVec2;

/// A point this near a vertex is that vertex when a curve is rotated, mm. Far below any output grid, far
/// above the rounding of coordinates in the metre range, so that no segment of length zero appears.
const AT_VERTEX: f64 = 1e-9;

/// The largest number of points that [`ClosedCurve::resampled`] gives.
const MOST_SAMPLES: f64 = 16_777_216.0;

/// A closed polyline: at least two distinct points, cyclic, the first not repeated at the end.
///
/// Two points make a there-and-back line: two segments, twice the length. Arc length s counts from vertex 0
/// in millimetres and is cyclic: s and s + length are the same place.
///
/// # Example
/// ```
/// use argil_curve::{ClosedCurve, DVec2};
/// let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)];
/// let square = ClosedCurve::new(square.map(DVec2::from).to_vec())?;
/// assert_eq!(square.length(), 8.0);
/// assert_eq!(square.point_at(3.0), DVec2::new(2.0, 1.0));
/// assert_eq!(square.point_at(-1.0), DVec2::new(0.0, 1.0));
/// assert_eq!(square.signed_area(), 4.0);
/// # Ok::<(), argil_curve::CurveError>(())
/// ```
///
/// A place on it is an arc length, or a segment and a share of it:
/// ```
/// use argil_curve::{ClosedCurve, DVec2, NearestOnCurve, OnCurve};
/// let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)];
/// let square = ClosedCurve::new(square.map(DVec2::from).to_vec())?;
/// assert_eq!((square.segment_count(), square.arc_of(3)), (4, 6.0));
/// assert_eq!((square.segments().count(), square.resampled(0.5).len()), (4, 16));
/// assert_eq!(square.locate(3.0), OnCurve { segment: 1, t: 0.5 });
/// assert_eq!((square.wrapped(9.5), square.arc_gap(0.5, 7.0)), (1.5, 1.5));
/// // The nearest place of all, and that of one segment.
/// let p = DVec2::new(1.0, -3.0);
/// let nearest = NearestOnCurve { segment: 0, s: 1.0, point: DVec2::new(1.0, 0.0), distance: 3.0 };
/// assert_eq!((square.nearest(p), square.on_segment(2, p).s), (nearest, 5.0));
/// // Begun in the middle of a side, which becomes a vertex.
/// assert_eq!(square.rotated_to(1.0).points()[..2], [(1.0, 0.0), (2.0, 0.0)].map(DVec2::from));
/// # Ok::<(), argil_curve::CurveError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Vec<DVec2>", into = "Vec<DVec2>"))]
pub struct ClosedCurve {
    points: Vec<DVec2>,
    /// Arc length at each vertex and, last, of the whole curve.
    arcs: Vec<f64>,
}

/// A place on a closed curve, by segment.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct OnCurve {
    /// Index of the segment, which begins at the vertex of the same index.
    pub segment: usize,
    /// Share of the segment's length that lies before the place, from 0 up to 1.
    pub t: f64,
}

/// The point of a closed curve that is nearest to some other point.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NearestOnCurve {
    /// Index of the segment on which the point lies.
    pub segment: usize,
    /// Arc length of the point, from 0 up to but excluding the length of the curve, mm.
    pub s: f64,
    /// The point itself, mm.
    pub point: DVec2,
    /// Its distance from the point that was asked about, mm.
    pub distance: f64,
}

impl TryFrom<Vec<DVec2>> for ClosedCurve {
    type Error = CurveError;

    fn try_from(points: Vec<DVec2>) -> Result<Self, CurveError> {
        Self::new(points)
    }
}

impl From<ClosedCurve> for Vec<DVec2> {
    fn from(curve: ClosedCurve) -> Self {
        curve.points
    }
}

impl ClosedCurve {
    /// A closed curve through `points`. Consecutive equal points, the last and the first included, count
    /// once.
    ///
    /// # Errors
    /// [`CurveError`] when a coordinate is not finite, when fewer than two distinct points are left, or when
    /// the length is not a finite number.
    pub fn new(points: Vec<DVec2>) -> Result<Self, CurveError> {
        if let Some(vertex) = points.iter().position(|p| !p.is_finite()) {
            return Err(CurveError::NotFinite { vertex });
        }
        let mut kept: Vec<DVec2> = Vec::with_capacity(points.len());
        for p in points {
            // Not `p != last`: points so near that their distance underflows to zero would leave a segment
            // without direction.
            if kept.last().is_none_or(|last| last.distance(p) > 0.0) {
                kept.push(p);
            }
        }
        while kept.len() > 1 && kept[0].distance(kept[kept.len() - 1]) <= 0.0 {
            kept.pop();
        }
        if kept.len() < 2 {
            return Err(CurveError::TooFewPoints { distinct: kept.len() });
        }
        let mut arcs = Vec::with_capacity(kept.len() + 1);
        let mut arc = 0.0;
        arcs.push(arc);
        for k in 0..kept.len() {
            arc += kept[k].distance(kept[(k + 1) % kept.len()]);
            arcs.push(arc);
        }
        if !arc.is_finite() {
            return Err(CurveError::TooLong);
        }
        Ok(Self { points: kept, arcs })
    }

    /// The vertices, in order.
    #[must_use]
    pub fn points(&self) -> &[DVec2] {
        &self.points
    }

    /// Number of segments, which is the number of vertices.
    #[must_use]
    pub fn segment_count(&self) -> usize {
        self.points.len()
    }

    /// The segment that begins at vertex `k`; `k` is cyclic.
    #[must_use]
    pub fn segment(&self, k: usize) -> Segment {
        let n = self.points.len();
        // A division costs more than all the rest.
        let k = if k < n { k } else { k % n };
        Segment::new(self.points[k], self.points[if k + 1 < n { k + 1 } else { 0 }])
    }

    /// All segments, in order.
    pub fn segments(&self) -> impl Iterator<Item = Segment> + '_ {
        (0..self.segment_count()).map(|k| self.segment(k))
    }

    /// Length of the whole curve, mm. Always positive and finite.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.arcs[self.points.len()]
    }

    /// Arc length from vertex 0 to `vertex`, mm; `vertex` is cyclic.
    #[must_use]
    pub fn arc_of(&self, vertex: usize) -> f64 {
        self.arcs[vertex % self.points.len()]
    }

    /// The same place on the curve with its arc length brought into one turn; 0 for what is not finite.
    #[must_use]
    pub fn wrapped(&self, s: f64) -> f64 {
        if s >= 0.0 && s < self.length() {
            return s;
        }
        let s = s.rem_euclid(self.length());
        // rem_euclid of a tiny negative number rounds up to the length itself.
        if s < self.length() { s } else { 0.0 }
    }

    /// The segment and the share of it at arc length `s`, which is cyclic.
    ///
    /// # Complexity
    /// O(log n).
    #[must_use]
    pub fn locate(&self, s: f64) -> OnCurve {
        let s = self.wrapped(s);
        let segment = self.arcs.partition_point(|&arc| arc <= s).clamp(1, self.points.len()) - 1;
        let length = self.arcs[segment + 1] - self.arcs[segment];
        let t = if length > 0.0 { ((s - self.arcs[segment]) / length).clamp(0.0, 1.0) } else { 0.0 };
        OnCurve { segment, t }
    }

    /// The point at arc length `s`, which is cyclic.
    ///
    /// # Complexity
    /// O(log n).
    #[must_use]
    pub fn point_at(&self, s: f64) -> DVec2 {
        let place = self.locate(s);
        self.segment(place.segment).point_at(place.t)
    }

    /// The point of the curve nearest to `p`; among equally near ones the one on the first segment.
    ///
    /// # Complexity
    /// O(n). For many questions about one curve build a [`SegmentIndex`](crate::SegmentIndex).
    #[must_use]
    pub fn nearest(&self, p: DVec2) -> NearestOnCurve {
        let mut least = self.segment(0).nearest(p).distance;
        let mut best = 0;
        for (k, ends) in self.points.windows(2).enumerate().skip(1) {
            let segment = Segment::new(ends[0], ends[1]);
            if !segment.is_beyond(p, least) {
                let distance = segment.nearest(p).distance;
                if distance < least {
                    (least, best) = (distance, k);
                }
            }
        }
        let last = self.segment_count() - 1;
        if self.segment(last).nearest(p).distance < least {
            best = last;
        }
        self.on_segment(best, p)
    }

    /// The point of segment `k` nearest to `p`, with its arc length on the curve; `k` is cyclic.
    #[must_use]
    pub fn on_segment(&self, k: usize, p: DVec2) -> NearestOnCurve {
        let segment = k % self.segment_count();
        let nearest = self.segment(segment).nearest(p);
        let length = self.arcs[segment + 1] - self.arcs[segment];
        let s = self.wrapped(self.arcs[segment] + nearest.t * length);
        NearestOnCurve { segment, s, point: nearest.point, distance: nearest.distance }
    }

    /// Arc length between `s` and `t` the shorter way round, mm.
    #[must_use]
    pub fn arc_gap(&self, s: f64, t: f64) -> f64 {
        let ahead = (self.wrapped(s) - self.wrapped(t)).abs();
        ahead.min(self.length() - ahead)
    }

    /// Points evenly spaced along the arc, the first at arc length 0: as few as make the spacing no more than
    /// `step` (mm), but at least 6, so that even a tiny loop keeps an inside. Point k lies at arc length k ×
    /// length / count. A step that is not positive gives 6; more than 2²⁴ points are never made.
    #[must_use]
    pub fn resampled(&self, step: f64) -> Vec<DVec2> {
        let wanted = if step > 0.0 { (self.length() / step).ceil() } else { 0.0 };
        let count = wanted.clamp(6.0, MOST_SAMPLES) as usize;
        let spacing = self.length() / count as f64;
        let mut segment = 0;
        let mut samples = Vec::with_capacity(count);
        for k in 0..count {
            let s = k as f64 * spacing;
            while segment + 1 < self.segment_count() && self.arcs[segment + 1] <= s {
                segment += 1;
            }
            let length = self.arcs[segment + 1] - self.arcs[segment];
            let t = if length > 0.0 { ((s - self.arcs[segment]) / length).clamp(0.0, 1.0) } else { 0.0 };
            samples.push(self.segment(segment).point_at(t));
        }
        samples
    }

    /// The same curve, begun at the point at arc length `s`. The point becomes a vertex, unless one lies
    /// there already (within 1e-9 mm); all vertices stay.
    #[must_use]
    pub fn rotated_to(&self, s: f64) -> ClosedCurve {
        let OnCurve { segment, t } = self.locate(s);
        let n = self.segment_count();
        let whole = self.segment(segment);
        let (first, inserted) = if whole.length() * t <= AT_VERTEX {
            (segment, None)
        } else if whole.length() * (1.0 - t) <= AT_VERTEX {
            (segment + 1, None)
        } else {
            (segment + 1, Some(whole.point_at(t)))
        };
        let points: Vec<DVec2> =
            inserted.into_iter().chain((0..n).map(|k| self.points[(first + k) % n])).collect();
        // The only new point is finite and lies apart from its neighbours; should rounding say otherwise, the
        // curve as it was is still the same closed curve.
        ClosedCurve::new(points).unwrap_or_else(|_| self.clone())
    }

    /// Enclosed area, positive when the curve runs counter-clockwise, mm².
    #[must_use]
    pub fn signed_area(&self) -> f64 {
        let origin = self.points[0];
        self.segments().map(|e| (e.start - origin).perp_dot(e.end - origin)).sum::<f64>() / 2.0
    }

    /// Whether `p` lies inside by the even-odd rule. On the curve itself the answer may be either.
    #[must_use]
    pub fn contains(&self, p: DVec2) -> bool {
        let mut inside = false;
        let mut start = self.points[self.points.len() - 1];
        for &end in &self.points {
            // Most segments lie wholly above or below.
            if (start.y <= p.y) != (end.y <= p.y) {
                let side = side(start, end, p);
                inside ^= if start.y <= p.y { side > 0.0 } else { side < 0.0 };
            }
            start = end;
        }
        inside
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(points: &[(f64, f64)]) -> Result<ClosedCurve, CurveError> {
        ClosedCurve::new(points.iter().map(|&p| DVec2::from(p)).collect())
    }

    #[test]
    fn equal_neighbours_count_once() {
        let c = curve(&[(0.0, 0.0), (0.0, 0.0), (1.0, 0.0), (1.0, 0.0), (0.0, 0.0)]).unwrap();
        assert_eq!(c.points().len(), 2);
        assert_eq!(c.length(), 2.0);
    }

    #[test]
    fn unfit_points_are_errors() {
        assert_eq!(curve(&[]), Err(CurveError::TooFewPoints { distinct: 0 }));
        assert_eq!(curve(&[(1.0, 1.0), (1.0, 1.0)]), Err(CurveError::TooFewPoints { distinct: 1 }));
        assert_eq!(curve(&[(1.0, 1.0), (f64::NAN, 1.0)]), Err(CurveError::NotFinite { vertex: 1 }));
        assert_eq!(curve(&[(1e200, 1.0), (-1e200, 1.0)]), Err(CurveError::TooLong));
    }

    #[test]
    fn arc_is_cyclic_even_for_odd_arguments() {
        let c = curve(&[(0.0, 0.0), (3.0, 0.0), (3.0, 4.0)]).unwrap();
        assert_eq!(c.length(), 12.0);
        assert_eq!(c.point_at(12.0), c.point_at(0.0));
        assert_eq!(c.point_at(-1e-300), DVec2::ZERO);
        assert_eq!(c.point_at(f64::NAN), DVec2::ZERO);
        assert_eq!(c.arc_gap(11.0, 1.0), 2.0);
        assert_eq!(c.locate(3.0), OnCurve { segment: 1, t: 0.0 });
    }

    #[test]
    fn rotation_keeps_vertices_and_inserts_one() {
        let c = curve(&[(0.0, 0.0), (3.0, 0.0), (3.0, 4.0)]).unwrap();
        assert_eq!(c.rotated_to(3.0).points(), &[c.points()[1], c.points()[2], c.points()[0]]);
        let inserted = c.rotated_to(1.0);
        assert_eq!(inserted.points()[0], DVec2::new(1.0, 0.0));
        assert_eq!(inserted.points().len(), 4);
        assert!((inserted.length() - 12.0).abs() < 1e-12);
    }

    #[test]
    fn odd_steps_give_six_points() {
        let c = curve(&[(0.0, 0.0), (3.0, 0.0), (3.0, 4.0)]).unwrap();
        for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(c.resampled(step).len(), 6);
        }
        assert_eq!(c.resampled(1.0).len(), 12);
    }

    #[test]
    fn inside_by_parity() {
        let c = curve(&[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]).unwrap();
        assert!(c.contains(DVec2::new(1.0, 1.0)));
        assert!(!c.contains(DVec2::new(5.0, 0.0)) && !c.contains(DVec2::new(-1.0, 4.0)));
    }
}
