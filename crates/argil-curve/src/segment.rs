//! A straight piece of a path.

use glam::DVec2;
use robust::{Coord, orient2d};

/// A straight piece of a path, in millimetres. It may have no length: it then stands for a point.
///
/// # Example
/// ```
/// use argil_curve::{DVec2, NearestOnSegment, Segment};
/// let segment = Segment::new(DVec2::ZERO, DVec2::new(4.0, 0.0));
/// let nearest: NearestOnSegment = segment.nearest(DVec2::new(1.0, 3.0));
/// assert_eq!((nearest.t, nearest.distance), (0.25, 3.0));
/// let beside = Segment::new(DVec2::new(1.0, 2.0), DVec2::new(9.0, 2.0));
/// assert_eq!(segment.distance_to(&beside), 2.0);
/// assert!(segment.is_within(DVec2::new(2.0, 0.4), 0.5) && !segment.crosses(&beside));
/// assert!(segment.is_boxed_beyond(&beside, 1.5) && !segment.is_boxed_beyond(&beside, 2.5));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Segment {
    /// Where the segment begins, mm.
    pub start: DVec2,
    /// Where the segment ends, mm.
    pub end: DVec2,
}

/// The point of a segment that is nearest to some other point.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NearestOnSegment {
    /// Share of the segment's length that lies before the point, 0 at the start and 1 at the end.
    pub t: f64,
    /// The point itself, mm.
    pub point: DVec2,
    /// Its distance from the point that was asked about, mm.
    pub distance: f64,
}

impl Segment {
    /// The segment from `start` to `end`.
    #[must_use]
    pub fn new(start: DVec2, end: DVec2) -> Self {
        Self { start, end }
    }

    /// Length in mm.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.start.distance(self.end)
    }

    /// The point at share `t` of the length. The ends come out exactly at `t` = 0 and `t` = 1.
    #[must_use]
    pub fn point_at(&self, t: f64) -> DVec2 {
        self.start.lerp(self.end, t)
    }

    /// The point of the segment nearest to `p`. A segment without length answers with its start.
    #[must_use]
    pub fn nearest(&self, p: DVec2) -> NearestOnSegment {
        let (t, point) = self.nearest_point(p);
        NearestOnSegment { t, point, distance: point.distance(p) }
    }

    /// The share of the length and the point nearest to `p`.
    #[inline]
    fn nearest_point(&self, p: DVec2) -> (f64, DVec2) {
        let along = self.end - self.start;
        let squared = along.length_squared();
        let t = if squared > 0.0 { ((p - self.start).dot(along) / squared).clamp(0.0, 1.0) } else { 0.0 };
        (t, self.point_at(t))
    }

    /// Whether `p` lies within `distance` mm of the segment, the distance itself included. For a `p` beside the
    /// segment that is farther, the answer takes no division.
    #[must_use]
    pub fn is_within(&self, p: DVec2, distance: f64) -> bool {
        !self.is_beyond(p, distance) && self.distance(p) <= distance
    }

    /// Whether `p` is certainly farther than `distance` from the segment. Without a division or a root, it spares most of a search
    /// the full answer.
    #[inline]
    pub(crate) fn is_beyond(&self, p: DVec2, distance: f64) -> bool {
        let (along, away) = (self.end - self.start, p - self.start);
        let squared = along.length_squared();
        let share = away.dot(along);
        // The products' rounding is below 1e-15 of the lengths they are made of; 1e-12 and 1e-9 leave room for all others.
        let slack = 1e-12 * (away.x.abs() + away.y.abs() + along.x.abs() + along.y.abs());
        let reach = distance * (1.0 + 1e-9) + slack;
        let reach = reach * reach;
        if share <= 0.0 {
            away.length_squared() > reach
        } else if share >= squared {
            (away - along).length_squared() > reach
        } else {
            let across = along.perp_dot(away);
            across * across > reach * squared
        }
    }

    /// Distance from `p` to the segment, mm.
    #[must_use]
    pub fn distance(&self, p: DVec2) -> f64 {
        self.nearest(p).distance
    }

    /// Least distance between the two segments, mm; 0 where they cross.
    #[must_use]
    pub fn distance_to(&self, other: &Segment) -> f64 {
        if self.crosses(other) {
            return 0.0;
        }
        // Segments that do not cross are nearest to one another at an end of one of them.
        // The root of the least square is the least root, to the bit.
        let square = |segment: &Segment, p: DVec2| segment.nearest_point(p).1.distance_squared(p);
        square(self, other.start)
            .min(square(self, other.end))
            .min(square(other, self.start))
            .min(square(other, self.end))
            .sqrt()
    }

    /// Whether the segments cross properly: each has its ends strictly on either side of the other.
    ///
    /// Touching, sharing an end and running along one another are no crossings. The sides come from a
    /// predicate with exact arithmetic, so neighbours of a path, which share an end, never count.
    #[must_use]
    pub fn crosses(&self, other: &Segment) -> bool {
        !self.lies_apart(other) && parted(self, other.start, other.end) && parted(other, self.start, self.end)
    }

    /// Whether the upright boxes round the segments are farther than `distance` mm apart along an axis, and so the segments. What is
    /// not may be farther all the same; this spares most of a search the full answer.
    #[inline]
    #[must_use]
    pub fn is_boxed_beyond(&self, other: &Segment, distance: f64) -> bool {
        let (low, high) = (self.start.min(self.end), self.start.max(self.end));
        let (others_low, others_high) = (other.start.min(other.end), other.start.max(other.end));
        (others_low - high).max(low - others_high).max_element() > distance
    }

    /// Whether the upright boxes round the segments have no point in common.
    #[inline]
    fn lies_apart(&self, other: &Segment) -> bool {
        let (low, high) = (self.start.min(self.end), self.start.max(self.end));
        let (others_low, others_high) = (other.start.min(other.end), other.start.max(other.end));
        high.x < others_low.x || others_high.x < low.x || high.y < others_low.y || others_high.y < low.y
    }

    /// The point where the lines through both segments meet; the middle of the shorter way for parallel ones.
    pub(crate) fn meeting_point(&self, other: &Segment) -> DVec2 {
        let (a, b) = (self.end - self.start, other.end - other.start);
        let t = (other.start - self.start).perp_dot(b) / a.perp_dot(b);
        if t.is_finite() { self.point_at(t.clamp(0.0, 1.0)) } else { self.point_at(0.5) }
    }
}

/// On which side of the line from `a` to `b` the point `c` lies: positive on the left, 0 exactly on the line.
pub(crate) fn side(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    let coord = |p: DVec2| Coord { x: p.x, y: p.y };
    orient2d(coord(a), coord(b), coord(c))
}

fn parted(line: &Segment, p: DVec2, q: DVec2) -> bool {
    let left = side(line.start, line.end, p);
    let right = side(line.start, line.end, q);
    (left > 0.0 && right < 0.0) || (left < 0.0 && right > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn segment(a: (f64, f64), b: (f64, f64)) -> Segment {
        Segment::new(DVec2::new(a.0, a.1), DVec2::new(b.0, b.1))
    }

    #[test]
    fn touching_is_no_crossing() {
        let bar = segment((0.0, 0.0), (2.0, 0.0));
        assert!(bar.crosses(&segment((1.0, -1.0), (1.0, 1.0))));
        assert!(!bar.crosses(&segment((1.0, 0.0), (1.0, 1.0))));
        assert!(!bar.crosses(&segment((2.0, 0.0), (3.0, 1.0))));
        assert!(!bar.crosses(&segment((1.0, 0.0), (3.0, 0.0))));
        assert!(!bar.crosses(&bar));
    }

    #[test]
    fn distance_between_segments() {
        let bar = segment((0.0, 0.0), (2.0, 0.0));
        assert_eq!(bar.distance_to(&segment((1.0, 2.0), (5.0, 2.0))), 2.0);
        assert_eq!(bar.distance_to(&segment((1.0, -2.0), (1.0, 2.0))), 0.0);
        assert_eq!(bar.distance_to(&segment((5.0, 4.0), (5.0, 4.0))), 5.0);
    }

    #[test]
    fn a_point_is_a_segment_too() {
        let point = segment((1.0, 1.0), (1.0, 1.0));
        assert_eq!(point.nearest(DVec2::new(1.0, 3.0)).distance, 2.0);
        assert_eq!(point.length(), 0.0);
    }
}
