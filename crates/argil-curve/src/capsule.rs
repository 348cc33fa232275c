//! Which part of a segment lies within a distance of another: segment against capsule, in closed form.

use crate::Segment;
use glam::DVec2;

/// A stretch of a segment, by arc length from the segment's start.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SegmentPart {
    /// Where the stretch begins, mm.
    pub from: f64,
    /// Where the stretch ends, mm; not before `from`.
    pub to: f64,
}

impl Segment {
    /// The part of this segment that lies within `radius` mm of `other`; `None` where no part does, or where
    /// this segment has no length.
    ///
    /// All points within a radius of a segment form a capsule: a disc about either end and the rectangle
    /// between them. A capsule is convex, so the part is one interval: the hull of the three that its pieces
    /// give.
    ///
    /// # Example
    /// ```
    /// use argil_curve::{DVec2, Segment, SegmentPart};
    /// let strand = Segment::new(DVec2::new(0.0, -2.0), DVec2::new(0.0, 2.0));
    /// let beam = Segment::new(DVec2::new(-1.0, 0.0), DVec2::new(1.0, 0.0));
    /// assert_eq!(strand.part_within(&beam, 0.5), Some(SegmentPart { from: 1.5, to: 2.5 }));
    /// ```
    #[must_use]
    pub fn part_within(&self, other: &Segment, radius: f64) -> Option<SegmentPart> {
        Cut::of(*self)?.part_within(other, radius)
    }
}

/// A segment that is cut with one capsule after the other.
pub(crate) struct Cut {
    segment: Segment,
    length: f64,
    ray: Ray,
}

impl Cut {
    /// `None` for a segment without length.
    pub(crate) fn of(segment: Segment) -> Option<Self> {
        let length = segment.length();
        let direction = (segment.end - segment.start) / length;
        direction.is_finite().then_some(Self {
            segment,
            length,
            ray: Ray { origin: segment.start, direction },
        })
    }

    pub(crate) fn length(&self) -> f64 {
        self.length
    }

    /// The part of the segment that lies within `radius` mm of `other`.
    #[inline]
    pub(crate) fn part_within(&self, other: &Segment, radius: f64) -> Option<SegmentPart> {
        // Far more than all rounding below: most of what an index visits lies outside of these boxes.
        let largest = self.segment.start.abs().max(other.start.abs()).max_element();
        if self.segment.is_boxed_beyond(other, radius * (1.0 + 1e-9) + 1e-12 * (largest + self.length)) {
            return None;
        }
        let ray = &self.ray;
        [ray.in_disc(other.start, radius), ray.in_disc(other.end, radius), ray.in_rectangle(other, radius)]
            .into_iter()
            .flatten()
            .reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
            .map(|(from, to)| SegmentPart { from: from.max(0.0), to: to.min(self.length) })
            .filter(|part| part.from <= part.to)
    }
}

/// The line of a segment with unit direction; intervals on it are in mm from the origin.
struct Ray {
    origin: DVec2,
    direction: DVec2,
}

impl Ray {
    fn in_disc(&self, centre: DVec2, radius: f64) -> Option<(f64, f64)> {
        let to_centre = centre - self.origin;
        let aside = self.direction.perp_dot(to_centre);
        let middle = self.direction.dot(to_centre);
        // As a product, so that a line that barely enters keeps its digits.
        let squared = (radius - aside) * (radius + aside);
        (squared >= 0.0).then(|| (middle - squared.sqrt(), middle + squared.sqrt()))
    }

    fn in_rectangle(&self, core: &Segment, radius: f64) -> Option<(f64, f64)> {
        let length = core.length();
        let axis = (core.end - core.start) / length;
        if !axis.is_finite() {
            return None;
        }
        let from_core = self.origin - core.start;
        let along = between(axis.dot(from_core), axis.dot(self.direction), 0.0, length)?;
        let aside = between(axis.perp_dot(from_core), axis.perp_dot(self.direction), -radius, radius)?;
        Some((along.0.max(aside.0), along.1.min(aside.1))).filter(|(from, to)| from <= to)
    }
}

/// Where the value `start + x * slope` lies between `low` and `high`.
fn between(start: f64, slope: f64, low: f64, high: f64) -> Option<(f64, f64)> {
    if slope == 0.0 {
        return (low <= start && start <= high).then_some((f64::NEG_INFINITY, f64::INFINITY));
    }
    let (a, b) = ((low - start) / slope, (high - start) / slope);
    Some((a.min(b), a.max(b)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn segment(a: (f64, f64), b: (f64, f64)) -> Segment {
        Segment::new(DVec2::from(a), DVec2::from(b))
    }

    fn part(segment: &Segment, other: &Segment, radius: f64) -> Option<(f64, f64)> {
        segment.part_within(other, radius).map(|part| (part.from, part.to))
    }

    #[test]
    fn a_line_across_a_capsule() {
        let across = segment((0.0, -2.0), (0.0, 2.0));
        assert_eq!(part(&across, &segment((-1.0, 0.0), (1.0, 0.0)), 0.5), Some((1.5, 2.5)));
        assert_eq!(part(&across, &segment((0.3, 0.0), (5.0, 0.0)), 0.5), Some((1.6, 2.4)));
        assert_eq!(part(&across, &segment((0.6, 0.0), (5.0, 0.0)), 0.5), None);
    }

    #[test]
    fn parallel_at_the_very_radius_is_held() {
        let bar = segment((0.0, 0.0), (4.0, 0.0));
        assert_eq!(part(&bar, &segment((1.0, 0.5), (3.0, 0.5)), 0.5), Some((1.0, 3.0)));
    }

    #[test]
    fn points_are_discs() {
        let bar = segment((0.0, 0.0), (4.0, 0.0));
        assert_eq!(part(&bar, &segment((2.0, 3.0), (2.0, 3.0)), 5.0), Some((0.0, 4.0)));
        assert_eq!(part(&segment((1.0, 1.0), (1.0, 1.0)), &bar, 5.0), None);
    }
}
