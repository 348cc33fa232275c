//! Where two strands run so close that one point below holds both.

use crate::coverage::Coverage;
use crate::placement::Placement;
use argil_curve::{ClosedCurve, DVec2, Segment, SegmentIndex};

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
    /// Arc length from one sample to the next.
    spacing: f64,
    /// For evenly spaced samples the arc length of the nearest place on another strand within reach, held or
    /// not. Runs are planned anew as points are shared, so what never changes is asked for once.
    twins: Vec<Option<f64>>,
}

impl<'a> Sharing<'a> {
    pub(crate) fn new(curve: &'a ClosedCurve, index: &'a SegmentIndex, placement: &Placement) -> Self {
        let reach = 2.0 * placement.share;
        let samples = curve.resampled(placement.step);
        let spacing = curve.length() / samples.len() as f64;
        let (apart, along) = (placement.apart, placement.along);
        let mut sharing = Self { curve, index, reach, apart, along, spacing, twins: Vec::new() };
        // Most segments have no other strand near them, and to ask once a segment is cheaper than at every
        // sample.
        let company: Vec<bool> = (0..curve.segment_count()).map(|k| sharing.has_company(k)).collect();
        let mut segment = 0;
        let twin = |(k, &p): (usize, &DVec2)| {
            let s = k as f64 * spacing;
            while segment + 1 < company.len() && curve.arc_of(segment + 1) <= s {
                segment += 1;
            }
            company[segment].then(|| sharing.nearest_twin(p, s, |_| true)).flatten().map(|twin| twin.s)
        };
        sharing.twins = samples.iter().enumerate().map(twin).collect();
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

    /// The nearest place on another strand within reach of the point `p` at arc length `s` that `suits`.
    fn nearest_twin(&self, p: DVec2, s: f64, suits: impl Fn(f64) -> bool) -> Option<Partner> {
        let mut best: Option<Partner> = None;
        let mut least = self.reach;
        self.index.for_each_near(Segment::new(p, p), self.reach, |k, segment| {
            if segment.distance(p) > least {
                return;
            }
            let other = self.curve.on_segment(k, p);
            if self.curve.arc_gap(other.s, s) > self.apart && suits(other.s) {
                least = other.distance;
                best = Some(Partner { s: other.s, point: other.point });
            }
        });
        best
    }

    /// The nearest place on another strand that one point could hold together with the place at `s`: it needs
    /// support, nothing holds it yet, and the arc between the two is longer than `apart`.
    pub(crate) fn partner(&self, s: f64, coverage: &Coverage<'_>) -> Option<Partner> {
        self.nearest_twin(self.curve.point_at(s), s, |other| self.is_open(other, coverage))
    }

    /// Whether a point at `s`, in 0 to two lengths of the curve, is likely to have a partner, judged by the
    /// sample next to it.
    pub(crate) fn has_partner(&self, s: f64, coverage: &Coverage<'_>) -> bool {
        let sample = (s / self.spacing).round() as usize % self.twins.len();
        self.twins[sample].is_some_and(|twin| self.is_open(twin, coverage))
    }

    /// Whether the place at `s` lies on a run that is still too long to be left alone.
    fn is_open(&self, s: f64, coverage: &Coverage<'_>) -> bool {
        // Runs between placed points are as long as allowed, up to rounding; they are served.
        coverage.free_about(s) > self.along * (1.0 + 1e-9)
    }
}
