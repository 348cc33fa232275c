//! What of the layer above is held, kept up to date while strands move.

use argil_curve::{ArcSpan, ClosedCurve, DVec2, PointIndex, Segment, SegmentIndex, gaps, held_spans};

use crate::TautOptions;

/// Samples for each `ε_along`: what hangs is measured up to one of them too long.
const SAMPLES: f64 = 64.0;

/// Samples in a row that a strand has to hold to count: a graze bears nothing.
const GRIP: usize = 3;

/// Side of the cells that samples are sorted into, in `ε_across`.
const CELL: f64 = 0.6;

/// A stretch of the curve above that no wall holds, as a range of samples.
#[derive(Clone, Copy, Debug)]
struct Run {
    first: usize,
    end: usize,
    /// The whole curve: its end meets its beginning.
    closed: bool,
}

/// The stretches that walls do not hold, sampled; every sample knows how many strands hold it.
#[derive(Debug)]
pub(crate) struct Holding {
    across: f64,
    /// The longest run of samples that may hang.
    most: usize,
    samples: PointIndex,
    runs: Vec<Run>,
    run_of: Vec<u32>,
    holders: Vec<u32>,
    /// Samples that have to be held by themselves.
    must: Vec<bool>,
    /// Samples that the present change has let go.
    lost: Vec<usize>,
}

impl Holding {
    /// What hangs of `above` between the walls. `starts` are points on it that must be held whatever lies beside them.
    pub(crate) fn new(
        above: &ClosedCurve,
        walls: &SegmentIndex,
        starts: &[DVec2],
        options: &TautOptions,
    ) -> Self {
        let across = options.used * options.across;
        let step = options.along / SAMPLES;
        let mut held = held_spans(above, walls, across);
        held.retain(|span| span.length >= GRIP as f64 * step);
        let (mut samples, mut runs, mut run_of) = (Vec::new(), Vec::new(), Vec::new());
        for gap in gaps(above.length(), &held) {
            if gap.length <= options.used * options.along && !starts.iter().any(|&p| lies_in(above, &gap, p))
            {
                continue;
            }
            let count = (gap.length / step).ceil().clamp(1.0, 1e6) as usize;
            let first = samples.len();
            samples.extend(
                (0..count).map(|k| above.point_at(gap.start + (k as f64 + 0.5) * gap.length / count as f64)),
            );
            run_of.resize(samples.len(), runs.len() as u32);
            runs.push(Run { first, end: samples.len(), closed: held.is_empty() });
        }
        let mut must = vec![false; samples.len()];
        for start in starts {
            let nearest = (0..samples.len()).min_by(|&a, &b| {
                samples[a].distance_squared(*start).total_cmp(&samples[b].distance_squared(*start))
            });
            if let Some(k) = nearest.filter(|&k| samples[k].distance(*start) <= step) {
                // It stands for the start itself, not for a place half a step away.
                samples[k] = *start;
                must[k] = true;
            }
        }
        Self {
            across,
            // A run of n hanging samples is at most n + 2 steps long, for one of them may stand a step aside.
            most: ((options.used * options.along / step).floor() as usize).saturating_sub(2),
            holders: vec![0; samples.len()],
            samples: PointIndex::new(&samples, CELL * across),
            runs,
            run_of,
            must,
            lost: Vec::new(),
        }
    }

    /// Counts a strand in.
    pub(crate) fn add(&mut self, strand: Segment) {
        let Self { samples, holders, across, .. } = self;
        samples.for_each_within(strand, *across, |k| holders[k] += 1);
    }

    fn remove(&mut self, strand: Segment) {
        let Self { samples, holders, across, lost, .. } = self;
        samples.for_each_within(strand, *across, |k| {
            holders[k] -= 1;
            if holders[k] == 0 {
                lost.push(k);
            }
        });
    }

    /// Puts two strands in the place of two others if nothing hangs for it that may not.
    pub(crate) fn exchange(&mut self, old: [Segment; 2], new: [Segment; 2]) -> bool {
        self.lost.clear();
        new.into_iter().for_each(|strand| self.add(strand));
        old.into_iter().for_each(|strand| self.remove(strand));
        if self.lost.iter().all(|&k| self.may_hang(k)) {
            return true;
        }
        old.into_iter().for_each(|strand| self.add(strand));
        new.into_iter().for_each(|strand| self.remove(strand));
        false
    }

    /// Whether the hanging stretch about a sample is short enough. Strands that hold fewer than [`GRIP`] samples in a row graze the
    /// curve and end no stretch.
    fn may_hang(&self, k: usize) -> bool {
        let run = self.runs[self.run_of[k] as usize];
        let most = self.most.min(run.end - run.first);
        let mut hanging = 1;
        for forward in [true, false] {
            let (mut at, mut held) = (k, 0);
            while held < GRIP {
                at = match (forward, run.closed) {
                    (true, false) if at + 1 == run.end => break,
                    (false, false) if at == run.first => break,
                    (true, true) if at + 1 == run.end => run.first,
                    (false, true) if at == run.first => run.end - 1,
                    (true, _) => at + 1,
                    (false, _) => at - 1,
                };
                held = if self.holders[at] > 0 { held + 1 } else { 0 };
                hanging += 1;
                if hanging > most + GRIP {
                    return false;
                }
            }
            hanging -= held;
        }
        hanging <= most && !self.must[k]
    }
}

/// Whether a point of the curve lies in a span of it.
fn lies_in(curve: &ClosedCurve, span: &ArcSpan, p: DVec2) -> bool {
    span.contains(curve.nearest(p).s, curve.length())
}
