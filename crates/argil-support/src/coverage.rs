//! Which stretches of a curve are held so far.

use argil_curve::{ArcSpan, ClosedCurve, DVec2, Segment, SegmentIndex};

/// A stretch of the curve that nothing holds yet; `end` may lie beyond the length of the curve, by up to one
/// turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Run {
    pub(crate) start: f64,
    pub(crate) end: f64,
}

impl Run {
    pub(crate) fn length(&self) -> f64 {
        self.end - self.start
    }
}

/// The held stretches of one curve, growing as points are placed.
pub(crate) struct Coverage<'a> {
    curve: &'a ClosedCurve,
    index: &'a SegmentIndex,
    /// Disjoint, in order, within one turn: a stretch over the beginning of the curve is kept as two.
    held: Vec<(f64, f64)>,
}

impl<'a> Coverage<'a> {
    /// Starts with what is held already. `index` holds the segments of `curve` in order.
    pub(crate) fn new(curve: &'a ClosedCurve, index: &'a SegmentIndex, held: &[ArcSpan]) -> Self {
        let mut coverage = Self { curve, index, held: Vec::with_capacity(2 * held.len() + 1) };
        for span in held {
            coverage.hold(span.start, span.end());
        }
        coverage
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.held.is_empty()
    }

    /// Holds every stretch of the curve within `radius` of `p`, on whichever strand, and `further` along it
    /// either way.
    pub(crate) fn hold_about(&mut self, p: DVec2, radius: f64, further: f64) {
        let point = Segment::new(p, p);
        let index = self.index;
        index.for_each_near(point, radius, |k, segment| {
            if let Some(part) = segment.part_within(&point, radius) {
                let arc = self.curve.arc_of(k);
                self.hold(arc + part.from - further, arc + part.to + further);
            }
        });
    }

    /// Holds the stretch from `start` to `end`, which may reach over the beginning of the curve either way.
    pub(crate) fn hold(&mut self, start: f64, end: f64) {
        let length = self.curve.length();
        if end - start >= length {
            self.insert(0.0, length);
            return;
        }
        let from = self.curve.wrapped(start);
        let to = from + (end - start);
        self.insert(from, to.min(length));
        if to > length {
            self.insert(0.0, to - length);
        }
    }

    fn insert(&mut self, start: f64, end: f64) {
        let first = self.held.partition_point(|h| h.1 < start);
        let last = self.held.partition_point(|h| h.0 <= end);
        if first >= last {
            self.held.insert(first, (start, end));
            return;
        }
        let merged = (start.min(self.held[first].0), end.max(self.held[last - 1].1));
        self.held[first] = merged;
        self.held.drain(first + 1..last);
    }

    /// The parts of `run` that nothing holds, in order.
    pub(crate) fn free_within(&self, run: Run) -> Vec<Run> {
        let length = self.curve.length();
        let mut free = Vec::new();
        let mut cursor = run.start;
        let from = self.held.partition_point(|h| h.1 <= run.start);
        let turn = |k: usize| if k < self.held.len() { 0.0 } else { length };
        for k in from..2 * self.held.len() {
            let (start, end) = self.held[k % self.held.len()];
            let (start, end) = (start + turn(k), end + turn(k));
            if start >= run.end {
                break;
            }
            if start > cursor {
                free.push(Run { start: cursor, end: start });
            }
            cursor = cursor.max(end);
        }
        if cursor < run.end {
            free.push(Run { start: cursor, end: run.end });
        }
        free
    }

    /// All stretches that nothing holds, each whole: one that reaches over the beginning of the curve is one
    /// run.
    pub(crate) fn runs(&self) -> Vec<Run> {
        let length = self.curve.length();
        let Some(&(first, _)) = self.held.first() else { return vec![Run { start: 0.0, end: length }] };
        self.free_within(Run { start: first, end: first + length })
    }

    /// Length of the stretch about arc length `s` that nothing holds; 0 where `s` is held.
    pub(crate) fn free_about(&self, s: f64) -> f64 {
        let length = self.curve.length();
        let (Some(&first), Some(&last)) = (self.held.first(), self.held.last()) else { return length };
        let s = self.curve.wrapped(s);
        let next = self.held.partition_point(|h| h.0 <= s);
        let before = if next == 0 { last.1 - length } else { self.held[next - 1].1 };
        let after = self.held.get(next).map_or(first.0 + length, |h| h.0);
        if before >= s { 0.0 } else { after - before }
    }

    /// Whether something between `start` and `end` is held, the ends not counted; less than one turn apart.
    pub(crate) fn meets(&self, start: f64, end: f64) -> bool {
        let length = self.curve.length();
        let from = self.curve.wrapped(start);
        let to = from + (end - start);
        let within = |from: f64, to: f64| {
            let next = self.held.partition_point(|h| h.1 <= from);
            self.held.get(next).is_some_and(|h| h.0 < to)
        };
        within(from, to) || (to > length && within(-1.0, to - length))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> ClosedCurve {
        ClosedCurve::new([(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)].map(DVec2::from).to_vec()).unwrap()
    }

    #[test]
    fn stretches_merge_and_split_at_the_beginning() {
        let curve = square();
        let index = SegmentIndex::of_curves([&curve], 1.0);
        let mut coverage = Coverage::new(&curve, &index, &[ArcSpan { start: 15.0, length: 2.0 }]);
        assert_eq!(coverage.runs(), [Run { start: 1.0, end: 15.0 }]);
        coverage.hold(5.0, 6.0);
        coverage.hold(5.5, 7.0);
        assert_eq!(coverage.runs(), [Run { start: 1.0, end: 5.0 }, Run { start: 7.0, end: 15.0 }]);
        assert_eq!(coverage.free_about(3.0), 4.0);
        assert_eq!((coverage.free_about(0.5), coverage.free_about(6.0)), (0.0, 0.0));
        assert!(coverage.meets(4.0, 5.5) && !coverage.meets(2.0, 5.0) && coverage.meets(14.0, 16.5));
        coverage.hold(-1.0, 16.0);
        assert!(coverage.runs().is_empty());
    }

    #[test]
    fn a_point_holds_every_strand_near_it() {
        let curve = square();
        let index = SegmentIndex::of_curves([&curve], 1.0);
        let mut coverage = Coverage::new(&curve, &index, &[]);
        coverage.hold_about(DVec2::new(2.0, 2.0), 2.5, 0.0);
        assert_eq!(coverage.runs().len(), 4);
        assert!(coverage.runs().iter().all(|run| (run.length() - 1.0).abs() < 1e-12));
    }
}
