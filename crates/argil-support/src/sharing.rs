//! Where two strands run so close that one point below holds both.

use crate::coverage::Coverage;
use crate::placement::Placement;
use argil_curve::{ClosedCurve, DVec2, SegmentIndex};

/// A place on another strand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Partner {
    pub(crate) s: f64,
    pub(crate) point: DVec2,
}

/// Finds partners for places of one curve.
pub(crate) struct Sharing<'a> {
    curve: &'a ClosedCurve,
    index: &'a SegmentIndex,
    /// Farthest partner: twice the distance of a shared point from either strand.
    reach: f64,
    apart: f64,
    along: f64,
    /// For each segment whether any strand is near it at all. Most have none, and asking once a segment is
    /// cheaper than asking at every place on it.
    company: Vec<bool>,
}

impl<'a> Sharing<'a> {
    pub(crate) fn new(curve: &'a ClosedCurve, index: &'a SegmentIndex, placement: &Placement) -> Self {
        let reach = 2.0 * placement.share;
        let mut sharing =
            Self { curve, index, reach, apart: placement.apart, along: placement.along, company: Vec::new() };
        sharing.company = (0..curve.segment_count()).map(|k| sharing.has_company(k)).collect();
        sharing
    }

    /// Whether some segment within reach may hold a place far enough away along the arc.
    fn has_company(&self, k: usize) -> bool {
        let segment = self.curve.segment(k);
        let half = segment.length() / 2.0;
        let middle = self.curve.arc_of(k) + half;
        let mut found = false;
        self.index.for_each_near(segment, self.reach, |other_k, other| {
            let other_half = other.length() / 2.0;
            let gap = self.curve.arc_gap(middle, self.curve.arc_of(other_k) + other_half);
            found =
                found || gap + half + other_half > self.apart && segment.distance_to(&other) <= self.reach;
        });
        found
    }

    /// The nearest place on another strand that one point could hold together with the place at `s`: it needs
    /// support, nothing holds it yet, and the arc between the two is longer than `apart`.
    pub(crate) fn partner(&self, s: f64, coverage: &Coverage<'_>) -> Option<Partner> {
        let place = self.curve.locate(s);
        if !self.company[place.segment] {
            return None;
        }
        let p = self.curve.segment(place.segment).point_at(place.t);
        let mut best: Option<(f64, Partner)> = None;
        self.index.for_each_near(argil_curve::Segment::new(p, p), self.reach, |k, _| {
            let other = self.curve.on_segment(k, p);
            let nearer = best.is_none_or(|(distance, _)| other.distance < distance);
            if nearer
                && other.distance <= self.reach
                && self.curve.arc_gap(other.s, s) > self.apart
                && self.is_open(other.s, coverage)
            {
                best = Some((other.distance, Partner { s: other.s, point: other.point }));
            }
        });
        best.map(|(_, partner)| partner)
    }

    /// Whether the place at `s` lies on a run that is still too long to be left alone.
    pub(crate) fn is_open(&self, s: f64, coverage: &Coverage<'_>) -> bool {
        // Runs between placed points are as long as allowed, up to rounding; they are served.
        coverage.free_about(s) > self.along * (1.0 + 1e-9)
    }
}
