//! Samples along a polyline and maximal runs of them.
//!
//! The audit samples where a file of any origin must be measured against several tolerances at once. A
//! stretch is known to about one step at either end, which the tolerances allow for; the planner's own checks
//! are exact, so the two ways of measuring are independent of one another.

use argil_curve::DVec2;

/// Segments shorter than this, mm, get no sample.
const NO_LENGTH: f64 = 1e-9;

/// A length that is a whole number of steps but for so much of a step, by rounding, is cut into that number.
const WHOLE: f64 = 1e-9;

/// A point in the middle of a short piece of a polyline.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample {
    pub(crate) at: DVec2,
    /// Length of the piece that the sample stands for, mm.
    pub(crate) length: f64,
    /// Segment of the polyline that the piece belongs to.
    pub(crate) segment: usize,
    /// Where on the segment, from 0 to 1.
    pub(crate) share: f64,
}

/// Cuts every segment into equal pieces no longer than `step` and puts a sample into the middle of each.
pub(crate) fn samples(points: &[DVec2], step: f64) -> Vec<Sample> {
    let mut samples = Vec::new();
    for (segment, pair) in points.windows(2).enumerate() {
        let length = pair[0].distance(pair[1]);
        if length <= NO_LENGTH {
            continue;
        }
        let pieces = (length / step - WHOLE).ceil().max(1.0) as usize;
        let share = 1.0 / pieces as f64;
        let middle = |k: usize| (k as f64 + 0.5) * share;
        samples.extend((0..pieces).map(|k| Sample {
            at: pair[0].lerp(pair[1], middle(k)),
            length: length * share,
            segment,
            share: middle(k),
        }));
    }
    samples
}

/// A maximal run of marked samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Run {
    /// Index of its first sample.
    pub(crate) first: usize,
    /// Index of its last one; less than that of the first where a run goes over the end of a cycle.
    pub(crate) last: usize,
    /// Index of the sample in the middle of the run.
    pub(crate) middle: usize,
    /// Length of the pieces in the run, mm.
    pub(crate) length: f64,
}

/// The maximal runs among `count` samples, of which `marked` tells which count and `length` how much;
/// `cyclic` joins the last with the first.
pub(crate) fn runs(
    count: usize,
    cyclic: bool,
    marked: impl Fn(usize) -> bool,
    length: impl Fn(usize) -> f64,
) -> Vec<Run> {
    let begin = if cyclic { (0..count).find(|&k| !marked(k)).unwrap_or(0) } else { 0 };
    let mut runs = Vec::new();
    let mut open: Option<(usize, f64)> = None;
    for turn in 0..=count {
        let k = if count > 0 { (begin + turn) % count } else { 0 };
        if turn < count && marked(k) {
            let (first, run) = open.unwrap_or((turn, 0.0));
            open = Some((first, run + length(k)));
        } else if let Some((first, length)) = open.take() {
            let at = |turn: usize| (begin + turn) % count;
            runs.push(Run { first: at(first), last: at(turn - 1), middle: at((first + turn) / 2), length });
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lengths(marks: &[u8], cyclic: bool) -> Vec<f64> {
        runs(marks.len(), cyclic, |k| marks[k] == 1, |_| 1.0).iter().map(|r| r.length).collect()
    }

    #[test]
    fn runs_wrap_only_when_cyclic() {
        assert_eq!(lengths(&[1, 1, 0, 1, 0, 1], false), [2.0, 1.0, 1.0]);
        assert_eq!(lengths(&[1, 1, 0, 1, 0, 1], true), [1.0, 3.0]);
        assert_eq!(lengths(&[1, 1, 1], true), [3.0]);
        assert_eq!(lengths(&[0, 0], true), [0.0; 0]);
        assert_eq!(lengths(&[], true), [0.0; 0]);
    }

    #[test]
    fn samples_stand_for_the_whole_length() {
        let path = [(0.0, 0.0), (1.0, 0.0), (1.0, 0.0), (1.0, 0.55)].map(DVec2::from);
        let samples = samples(&path, 0.25);
        assert_eq!(samples.len(), 4 + 3);
        assert!((samples.iter().map(|s| s.length).sum::<f64>() - 1.55).abs() < 1e-12);
        assert_eq!(samples[4].segment, 2);
        assert_eq!(samples[0].at, DVec2::new(0.125, 0.0));
    }
}
