//! The stretches of a curve that lie near a set of segments, and the stretches between them.

use crate::capsule::Cut;
use crate::{ClosedCurve, SegmentIndex};

/// Spans of arc length nearer than this are one span, mm. Two segments that meet at a vertex give two parts
/// whose ends differ by rounding; without joining, every vertex would be a gap of 1e-16 mm.
const JOIN: f64 = 1e-9;

/// A stretch of a closed curve by arc length; it may run over the end of the curve into its beginning.
///
/// # Example
/// ```
/// use argil_curve::ArcSpan;
/// // On a curve of 10 mm: over its end, into its beginning.
/// let span = ArcSpan { start: 9.0, length: 2.0 };
/// assert_eq!(span.end(), 11.0);
/// assert!(span.contains(0.5, 10.0) && !span.contains(1.5, 10.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ArcSpan {
    /// Arc length where the stretch begins, from 0 up to but excluding the length of the curve, mm.
    pub start: f64,
    /// Length of the stretch, mm.
    pub length: f64,
}

impl ArcSpan {
    /// Arc length where the stretch ends, mm; beyond the length of the curve when it runs over the beginning.
    #[must_use]
    pub fn end(&self) -> f64 {
        self.start + self.length
    }

    /// Whether the place at arc length `s` of a curve of length `curve_length` lies in the stretch, its ends
    /// included.
    #[must_use]
    pub fn contains(&self, s: f64, curve_length: f64) -> bool {
        (s - self.start).rem_euclid(curve_length) <= self.length
    }
}

/// The stretches of `curve` whose points lie within `across` mm of some segment of `index`.
///
/// Exact up to rounding: each segment of the curve is cut with the capsule about each segment near it,
/// nothing is sampled (the continuous form of Eq. 1 of the paper, which tests samples). The spans are
/// disjoint, in the order of their starts, and joined over the beginning of the curve; a curve that is held
/// all round gives one span that starts at 0 and has the curve's full length. Spans that touch, within 1e-9
/// mm, are one. A curve that only grazes the distance gives a span without length. A negative or undefined
/// `across` holds nothing.
///
/// # Complexity
/// O(n + pairs of segments that lie near each other), plus sorting the parts of each segment.
///
/// # Example
/// ```
/// use argil_curve::{ClosedCurve, DVec2, Segment, SegmentIndex, held_spans};
/// let square = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)];
/// let square = ClosedCurve::new(square.map(DVec2::from).to_vec())?;
/// let bar = Segment::new(DVec2::new(2.0, -1.0), DVec2::new(2.0, 1.0));
/// let held = held_spans(&square, &SegmentIndex::new(vec![bar], 1.0), 0.5);
/// assert_eq!(held.len(), 1);
/// assert!((held[0].start - 1.5).abs() < 1e-12 && (held[0].length - 1.0).abs() < 1e-12);
/// # Ok::<(), argil_curve::CurveError>(())
/// ```
#[must_use]
pub fn held_spans(curve: &ClosedCurve, index: &SegmentIndex, across: f64) -> Vec<ArcSpan> {
    if across.is_nan() || across < 0.0 {
        return Vec::new();
    }
    let length = curve.length();
    let join = JOIN.max(8.0 * f64::EPSILON * length);
    let mut runs: Vec<(f64, f64)> = Vec::new();
    let mut parts: Vec<(f64, f64)> = Vec::new();
    for (k, segment) in curve.segments().enumerate() {
        let offset = curve.arc_of(k);
        parts.clear();
        let Some(cut) = Cut::of(segment) else { continue };
        // What one segment holds whole no other can hold more of.
        let mut whole = false;
        index.for_each_near(segment, across, |_, other| {
            if whole {
                return;
            }
            let part = cut.part_within(&other, across);
            whole = part.is_some_and(|part| part.from == 0.0 && part.to == cut.length());
            parts.extend(part.map(|part| (offset + part.from, offset + part.to)));
        });
        parts.sort_by(|a, b| a.0.total_cmp(&b.0));
        for &(from, to) in &parts {
            match runs.last_mut() {
                Some(last) if from <= last.1 + join => last.1 = last.1.max(to),
                _ => runs.push((from, to)),
            }
        }
    }
    join_round(&mut runs, length, join);
    runs.iter().map(|&(from, to)| ArcSpan { start: from, length: to - from }).collect()
}

/// Joins the last run with the first where they meet over the beginning of the curve; all begin before the end then.
fn join_round(runs: &mut Vec<(f64, f64)>, length: f64, join: f64) {
    let (Some(&first), Some(&last)) = (runs.first(), runs.last()) else { return };
    if last.0 >= length {
        // What is held at the very end alone is held at the beginning, and so comes first.
        runs.pop();
        match runs.first_mut() {
            Some(first) if first.0 <= join => first.0 = 0.0,
            _ => runs.insert(0, (0.0, 0.0)),
        }
        return;
    }
    if first.0 > join || last.1 < length - join {
        return;
    }
    if runs.len() == 1 {
        runs[0] = (0.0, length);
        return;
    }
    let end = runs.len() - 1;
    runs[end].1 = length + first.1;
    runs.remove(0);
}

/// The stretches of a curve of length `curve_length` between the `held` ones: what [`held_spans`] leaves.
///
/// Nothing held gives one gap that starts at 0 and has the full length. `held` must be disjoint and ordered
/// by start, as `held_spans` gives it; the gaps come out the same way.
#[must_use]
pub fn gaps(curve_length: f64, held: &[ArcSpan]) -> Vec<ArcSpan> {
    if held.is_empty() {
        return vec![ArcSpan { start: 0.0, length: curve_length }];
    }
    let mut between: Vec<ArcSpan> = (0..held.len())
        .filter_map(|k| {
            let start = held[k].end();
            let next = held.get(k + 1).map_or(held[0].start + curve_length, |span| span.start);
            let start_in_turn = if start < curve_length { start } else { start - curve_length };
            (next > start).then_some(ArcSpan { start: start_in_turn, length: next - start })
        })
        .collect();
    between.sort_by(|a, b| a.start.total_cmp(&b.start));
    between
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Segment;
    use glam::DVec2;

    fn square() -> ClosedCurve {
        ClosedCurve::new([(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)].map(DVec2::from).to_vec()).unwrap()
    }

    #[test]
    fn held_all_round_is_one_span() {
        let index = SegmentIndex::of_curves([&square()], 1.0);
        let held = held_spans(&square(), &index, 0.1);
        assert_eq!(held, [ArcSpan { start: 0.0, length: 16.0 }]);
        assert!(gaps(16.0, &held).is_empty());
    }

    #[test]
    fn a_span_over_the_beginning_is_joined() {
        let corner = Segment::new(DVec2::ZERO, DVec2::ZERO);
        let held = held_spans(&square(), &SegmentIndex::new(vec![corner], 1.0), 1.0);
        assert_eq!(held, [ArcSpan { start: 15.0, length: 2.0 }]);
        assert_eq!(gaps(16.0, &held), [ArcSpan { start: 1.0, length: 14.0 }]);
        assert!(held[0].contains(0.5, 16.0) && held[0].contains(15.5, 16.0) && !held[0].contains(8.0, 16.0));
    }

    #[test]
    fn what_is_held_at_the_very_end_comes_first() {
        let rounds = |mut runs: Vec<(f64, f64)>| {
            join_round(&mut runs, 16.0, JOIN);
            runs
        };
        assert_eq!(rounds(vec![(16.0, 16.0)]), [(0.0, 0.0)]);
        assert_eq!(rounds(vec![(4.0, 5.0), (16.0, 16.0)]), [(0.0, 0.0), (4.0, 5.0)]);
        assert_eq!(rounds(vec![(0.0, 1.0), (4.0, 5.0), (16.0, 16.0)]), [(0.0, 1.0), (4.0, 5.0)]);
        assert_eq!(rounds(vec![(0.0, 1.0), (4.0, 5.0), (15.0, 16.0)]), [(4.0, 5.0), (15.0, 17.0)]);
        let spans = [ArcSpan { start: 0.0, length: 0.0 }, ArcSpan { start: 4.0, length: 1.0 }];
        assert_eq!(gaps(16.0, &spans).iter().map(|gap| gap.length).sum::<f64>(), 15.0);
    }

    #[test]
    fn nothing_near_is_one_gap() {
        let empty = SegmentIndex::new(Vec::new(), 1.0);
        assert!(held_spans(&square(), &empty, 1.0).is_empty());
        assert_eq!(gaps(16.0, &[]), [ArcSpan { start: 0.0, length: 16.0 }]);
        let index = SegmentIndex::of_curves([&square()], 1.0);
        assert!(held_spans(&square(), &index, f64::NAN).is_empty());
    }
}
