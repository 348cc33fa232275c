//! The exact check of a smoothed layer, and the repair that pulls it back towards its candidate.

use argil_curve::{ClosedCurve, DVec2, SegmentIndex, on_grid, self_crossings};
use argil_support::{Criterion, unsupported_spans};

/// What is wrong with a path, if anything.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Fault {
    /// Places of a stretch of the layer above that is not held, and its length.
    Unsupported { at: Vec<DVec2>, length: f64 },
    /// A place where the path crosses itself.
    Crossing { at: Vec<DVec2> },
}

/// What a layer's path has to hold and how it is measured.
pub(crate) struct Check<'a> {
    /// The cycle above, if there is one.
    pub(crate) above: Option<&'a ClosedCurve>,
    /// ε, with nothing in hand.
    pub(crate) criterion: Criterion,
    /// Bead width, mm.
    pub(crate) width: f64,
    /// Output grid, mm.
    pub(crate) grid: f64,
}

/// Rounds of repair; the last one goes back to the candidate where anything is wrong.
const ROUNDS: usize = 8;

impl Check<'_> {
    /// The first kind of fault of a closed path: crossings, then spans of the layer above that hang.
    pub(crate) fn fault(&self, points: &[DVec2]) -> Option<Fault> {
        let crossings = self_crossings(points);
        if !crossings.is_empty() {
            return Some(Fault::Crossing { at: crossings.iter().map(|c| c.point).collect() });
        }
        let above = self.above?;
        let below = match ClosedCurve::new(points.to_vec()) {
            // Questions reach `ε_across` far.
            Ok(curve) => SegmentIndex::of_curves([&curve], 0.5 * self.width),
            Err(_) => SegmentIndex::new(Vec::new(), self.width),
        };
        let spans = unsupported_spans(above, &below, &self.criterion);
        let length = spans.iter().map(|span| span.length).fold(0.0, f64::max);
        let at: Vec<DVec2> = spans
            .iter()
            .flat_map(|s| [0.0, 0.25, 0.5, 0.75, 1.0].map(|t| above.point_at(s.start + t * s.length)))
            .collect();
        (!at.is_empty()).then_some(Fault::Unsupported { at, length })
    }

    /// Rounds free points to the output grid.
    pub(crate) fn rounded(&self, points: &mut [DVec2], fixed: &[bool]) {
        for (point, _) in points.iter_mut().zip(fixed).filter(|(_, fixed)| !**fixed) {
            *point = on_grid(*point, self.grid);
        }
    }

    /// Pulls the vertices round every fault back towards the candidate, farther and wider each round, until nothing is
    /// wrong. Returns how many vertices moved, or the fault that stays with the candidate itself.
    pub(crate) fn repair(
        &self,
        points: &mut [DVec2],
        candidate: &[DVec2],
        fixed: &[bool],
    ) -> Result<usize, Fault> {
        self.rounded(points, fixed);
        let smooth = points.to_vec();
        let mut share = vec![0.0_f64; points.len()];
        for round in 0..=ROUNDS {
            let Some(fault) = self.fault(points) else {
                return Ok(share.iter().filter(|&&s| s > 0.0).count());
            };
            if round == ROUNDS {
                return Err(fault);
            }
            let (Fault::Unsupported { at, .. } | Fault::Crossing { at }) = &fault;
            let reach = (1.3 + round as f64) * self.width;
            for k in 0..points.len() {
                if fixed[k] {
                    continue;
                }
                let near = |p: &DVec2| p.distance(points[k]) < reach || p.distance(candidate[k]) < reach;
                if round + 1 == ROUNDS || at.iter().any(near) {
                    share[k] = if round < ROUNDS / 2 { 0.5 * (1.0 + share[k]) } else { 1.0 };
                    points[k] = smooth[k].lerp(candidate[k], share[k]);
                }
            }
            self.rounded(points, fixed);
        }
        Ok(0)
    }
}
