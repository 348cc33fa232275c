//! The fewest points that hold one run, by dynamic programming.

use crate::coverage::Run;
use crate::placement::Placement;

/// Fewest candidates between two neighbouring points, however coarse the step: with fewer a run could end up
/// without a place to choose.
const FEWEST_STEPS: f64 = 8.0;

/// Most candidates between two neighbouring points; finer steps change nothing but the time.
const MOST_STEPS: f64 = 256.0;

/// Cost of a gap of full length, in points, the cost growing with the square of the gap: among plans of equal
/// count the even one leaves the most room for error. Small enough never to be worth a point: one more point
/// lowers the sum of squares by less than 1.
const UNEVEN: f64 = 0.05;

/// Lengths that differ by less are equal, as a share of the longest bridge: rounding must not cost a point.
const ROUNDING: f64 = 1e-9;

/// The cheapest plan from every place of a run to the run's end.
///
/// Planned from the end, so that when a point turns out to hold something further along too, the plan for
/// what comes after that is there already.
pub(crate) struct RunPlan {
    run: Run,
    at_end: f64,
    rounding: f64,
    /// Arc from the start of the run to the first candidate, and from one candidate to the next, mm.
    first: f64,
    spacing: f64,
    /// Least cost of a plan for the rest of the run that begins with a point on the candidate.
    cost: Vec<f64>,
    /// The point after it; `None` for the last.
    next: Vec<Option<u32>>,
}

impl RunPlan {
    /// Plans `run`, which is longer than the longest bridge. `price` is what a point at an arc length costs;
    /// 1 is a plain point.
    ///
    /// Candidates lie at a spacing that divides the longest distance between two points, the first set so
    /// that the greedy plan (every gap as long as it may be) is among them: on a plain run the count is
    /// therefore the least possible.
    ///
    /// # Complexity
    /// O(candidates × candidates between two points).
    pub(crate) fn new(run: Run, placement: &Placement, mut price: impl FnMut(f64) -> f64) -> Self {
        let (between, at_end) = (placement.between(), placement.at_end());
        let window = (between / placement.step).ceil().clamp(FEWEST_STEPS, MOST_STEPS) as usize;
        let spacing = between / window as f64;
        let rounding = ROUNDING * between;
        let length = run.length();
        let mut first = at_end - (at_end / spacing).floor() * spacing;
        if first > length {
            // Only with a bridge much shorter than what a point holds: one point anywhere does.
            first = length / 2.0;
        }
        let count = ((length - first + rounding) / spacing) as usize + 1;
        let between_cost: Vec<f64> = (0..=window).map(|k| uneven(k as f64 * spacing, between)).collect();
        let mut plan = Self {
            run,
            at_end,
            rounding,
            first,
            spacing,
            cost: vec![f64::INFINITY; count],
            next: vec![None; count],
        };
        for k in (0..count).rev() {
            let rest = (length - plan.offset(k)).max(0.0);
            let mut least = if rest <= at_end + rounding { uneven(rest, at_end) } else { f64::INFINITY };
            for after in k + 1..(k + window + 1).min(count) {
                let cost = plan.cost[after] + between_cost[after - k];
                if cost < least {
                    least = cost;
                    plan.next[k] = Some(after as u32);
                }
            }
            plan.cost[k] = least + price(plan.place(k));
        }
        plan
    }

    /// The first point of the cheapest plan for the part of the run from `start` on, whose start is held.
    pub(crate) fn first_from(&self, start: f64) -> Option<usize> {
        let from = start - self.run.start;
        let mut best: Option<(f64, usize)> = None;
        let k = ((from - self.first - self.rounding) / self.spacing).ceil().max(0.0) as usize;
        for k in k..self.cost.len() {
            let gap = (self.offset(k) - from).max(0.0);
            if gap > self.at_end + self.rounding {
                break;
            }
            let cost = self.cost[k] + uneven(gap, self.at_end);
            if best.is_none_or(|(least, _)| cost < least) {
                best = Some((cost, k));
            }
        }
        best.map(|(_, k)| k)
    }

    /// The point that follows point `k`.
    pub(crate) fn next(&self, k: usize) -> Option<usize> {
        self.next[k].map(|k| k as usize)
    }

    /// Arc length of candidate `k` on the curve, within the run.
    pub(crate) fn place(&self, k: usize) -> f64 {
        self.run.start + self.offset(k).min(self.run.length())
    }

    fn offset(&self, k: usize) -> f64 {
        self.first + k as f64 * self.spacing
    }
}

fn uneven(gap: f64, limit: f64) -> f64 {
    UNEVEN * (gap / limit).powi(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn placement() -> Placement {
        Placement::for_width(1.5)
    }

    fn fewest_points(run: Run, placement: &Placement, price: impl FnMut(f64) -> f64) -> Vec<f64> {
        let plan = RunPlan::new(run, placement, price);
        std::iter::successors(plan.first_from(run.start), |&k| plan.next(k)).map(|k| plan.place(k)).collect()
    }

    #[test]
    fn a_plain_run_gets_the_least_count() {
        let p = placement();
        for (points, length) in [
            (1, 2.0 * p.at_end()),
            (2, 2.0 * p.at_end() + p.between()),
            (40, 2.0 * p.at_end() + 39.0 * p.between()),
        ] {
            let run = Run { start: 7.0, end: 7.0 + length };
            assert_eq!(fewest_points(run, &p, |_| 1.0).len(), points);
            let longer = Run { start: 7.0, end: 7.0 + length + 1e-3 };
            assert_eq!(fewest_points(longer, &p, |_| 1.0).len(), points + 1);
        }
    }

    #[test]
    fn gaps_are_even_where_nothing_else_matters() {
        let points = fewest_points(Run { start: 0.0, end: 12.0 }, &placement(), |_| 1.0);
        let gaps: Vec<f64> = points.windows(2).map(|pair| pair[1] - pair[0]).collect();
        assert!(gaps.iter().all(|gap| (gap - gaps[0]).abs() < 0.25), "{points:?}");
    }

    #[test]
    fn a_dear_place_is_passed_over() {
        let dear = |s: f64| if (s - 2.0).abs() < 0.3 { 2.5 } else { 1.0 };
        let points = fewest_points(Run { start: 0.0, end: 4.0 }, &placement(), dear);
        assert_eq!(points.len(), 1);
        assert!((points[0] - 2.0).abs() >= 0.3);
    }

    #[test]
    fn a_coarse_step_still_serves_a_short_run() {
        let coarse = Placement { step: 1e9, held: 100.0, ..placement() };
        assert_eq!(fewest_points(Run { start: 0.0, end: 3.0 }, &coarse, |_| 1.0).len(), 1);
    }
}
