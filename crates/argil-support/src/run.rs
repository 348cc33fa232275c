//! The fewest points that hold one run, by dynamic programming.

use crate::coverage::Run;
use crate::placement::Placement;

/// Fewest candidates between two neighbouring points, however coarse the step: with fewer a run could end up
/// without a place to choose.
const FEWEST_STEPS: f64 = 8.0;

/// Most candidates between two neighbouring points; finer steps change nothing but the time.
const MOST_STEPS: f64 = 256.0;

/// Cost of a gap of full length, in points, the cost growing with the square of the gap: among plans of equal count the
/// even one leaves the most room for error. Small enough never to be worth a point: one more point lowers the
/// sum of squares by less than 1.
const UNEVEN: f64 = 0.05;

/// Lengths that differ by less are equal, as a share of the longest bridge: rounding must not cost a point.
const ROUNDING: f64 = 1e-9;

/// Arc lengths of the points that hold `run` at the least cost, in order. `cost` prices a point at an arc length;
/// 1 is a plain point.
///
/// Candidates lie at a spacing that divides the longest distance between two points, the first set so that the
/// greedy plan (every gap as long as it may be) is among them: on a plain run the count is therefore the least possible.
///
/// # Complexity
/// O(candidates × candidates between two points).
pub(crate) fn fewest_points(run: Run, placement: &Placement, mut cost: impl FnMut(f64) -> f64) -> Vec<f64> {
    let (between, at_end) = (placement.between(), placement.at_end());
    let window = (between / placement.step).ceil().clamp(FEWEST_STEPS, MOST_STEPS) as usize;
    let spacing = between / window as f64;
    let first = at_end - (at_end / spacing).floor() * spacing;
    let length = run.length();
    let rounding = ROUNDING * between;
    if length < first {
        return vec![run.start + length / 2.0];
    }
    let count = ((length - first + rounding) / spacing) as usize + 1;
    let place = |k: usize| first + k as f64 * spacing;
    let uneven = |gap: f64, limit: f64| UNEVEN * (gap / limit).powi(2);
    let between_cost: Vec<f64> = (0..=window).map(|k| uneven(k as f64 * spacing, between)).collect();

    // best[k]: least cost of a plan for the run up to candidate k with a point on it; from[k]: the point before.
    let mut best = vec![f64::INFINITY; count];
    let mut from: Vec<Option<usize>> = vec![None; count];
    for k in 0..count {
        let own = cost(run.start + place(k));
        if place(k) <= at_end + rounding {
            best[k] = own + uneven(place(k), at_end);
        }
        for before in k.saturating_sub(window)..k {
            let total = best[before] + between_cost[k - before] + own;
            if total < best[k] {
                best[k] = total;
                from[k] = Some(before);
            }
        }
    }
    let rest = |k: usize| (length - place(k)).max(0.0);
    let total = |k: usize| best[k] + uneven(rest(k), at_end);
    let mut last = count - 1;
    for k in (0..count).rev().take_while(|&k| rest(k) <= at_end + rounding) {
        if total(k) < total(last) {
            last = k;
        }
    }
    let mut points = vec![run.start + place(last).min(length)];
    while let Some(before) = from[last] {
        points.push(run.start + place(before));
        last = before;
    }
    points.reverse();
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    fn placement() -> Placement {
        Placement::for_width(1.5)
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
