//! Sharp turns of the free strand are cut: a nozzle that reverses on the spot heaps clay.

use argil_curve::DVec2;
use argil_route::Cycle;

/// Turns sharper than this are cut, degrees. The limit that is measured is 135°.
const SHARPEST: f64 = 125.0;
/// Length of the cut along each arm, in w.
const CUT: f64 = 0.08;
/// Least half width of the new tip, in w.
const TIP: f64 = 0.04;

/// How far beyond the turn the new tip lies, in w, and where it would hold less than the turn did all the same.
const OUT: [f64; 2] = [0.04, 0.1];
/// How far a place where a cut failed concerns the turns round it, in w.
const SPARE: f64 = 1.3;

/// Replaces the vertex of every sharp turn in a free stretch by two that stand across the tip. A vertex that carries
/// a demand hands it on to the first of them. Turns near a `failed` place are cut farther out, and such as are near two of them stay.
/// Returns `None` where nothing is sharp.
pub(crate) fn blunted(cycle: &Cycle, width: f64, failed: &[DVec2]) -> Option<Cycle> {
    let n = cycle.points.len();
    let mut out = Cycle { roots: cycle.roots, ..Cycle::default() };
    let mut place = Vec::with_capacity(n);
    let mut hit = false;
    for k in 0..n {
        let [from, here, to] = [k + n - 1, k, k + 1].map(|j| cycle.points[j % n]);
        place.push(out.points.len());
        let mut push = |at: DVec2, fixed: bool| {
            out.points.push(at);
            out.fixed.push(fixed);
            out.legs.push(cycle.legs[k]);
        };
        let failures = failed.iter().filter(|p| p.distance(here) < SPARE * width).count();
        if !cycle.fixed[k] && failures < OUT.len() && is_sharp(from, here, to) {
            hit = true;
            tip([from, here, to], width, OUT[failures]).into_iter().for_each(|p| push(p, false));
        } else {
            push(here, cycle.fixed[k]);
        }
    }
    out.carriers = cycle.carriers.iter().map(|&(k, demand)| (place[k], demand)).collect();
    hit.then_some(out)
}

fn is_sharp(from: DVec2, here: DVec2, to: DVec2) -> bool {
    let arms = (here - from).try_normalize().zip((to - here).try_normalize());
    arms.is_some_and(|(a, b)| a.angle_to(b).abs().to_degrees() >= SHARPEST)
}

/// The two vertices that cut a sharp turn, in the order of the walk: a little farther out than the turn, lest the cut hold less than it did.
fn tip([from, here, to]: [DVec2; 3], width: f64, out: f64) -> [DVec2; 2] {
    let (into, onward) = (here - from, to - here);
    let (a, b) = (into.normalize_or_zero(), onward.normalize_or_zero());
    let cut = (CUT * width).min(0.4 * into.length()).min(0.4 * onward.length());
    let (p, q) = (here - cut * a, here + cut * b);
    // Across the tip, from the incoming arm to the outgoing one.
    let axis = (a - b).normalize_or(a);
    let across = if (q - p).dot(axis.perp()) >= 0.0 { axis.perp() } else { -axis.perp() };
    let half = (0.5 * (q - p).length()).max(TIP * width);
    let outwards = here + out * width * axis;
    [outwards - half * across, outwards + half * across]
}

#[cfg(test)]
mod tests {
    use argil_route::Leg;

    use super::*;

    /// Free strand through the points.
    fn strand(points: &[(f64, f64)]) -> Cycle {
        Cycle {
            points: points.iter().map(|&p| DVec2::from(p)).collect(),
            fixed: vec![false; points.len()],
            legs: vec![Leg::Support; points.len()],
            carriers: vec![(1, 7)],
            roots: 0,
        }
    }

    #[test]
    fn a_reversal_becomes_two_right_angles() {
        let [before, after] = [DVec2::new(-2.0, 0.1), DVec2::new(-2.0, -0.1)];
        let [p, q] = tip([before, DVec2::ZERO, after], 1.5, 0.0);
        assert!(p.y > 0.0 && q.y < 0.0, "{p} {q}: in the order of the walk");
        assert!(!is_sharp(before, p, q) && !is_sharp(p, q, after));
    }

    #[test]
    fn a_gentle_turn_stays() {
        assert_eq!(blunted(&strand(&[(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]), 1.5, &[]), None);
    }

    #[test]
    fn turns_are_cut_farther_out_where_a_cut_failed_and_stay_where_two_did() {
        let sharp = strand(&[(0.0, 0.0), (9.0, 0.0), (0.0, 0.5), (-2.0, 2.0), (-3.0, 0.2)]);
        let failed = DVec2::new(9.0, 1.0);
        let cut = |failed: &[DVec2]| blunted(&sharp, 1.5, failed).unwrap();
        let reach = |cut: &Cycle| cut.points.iter().map(|p| p.x).fold(0.0, f64::max);
        assert_eq!(cut(&[]).points.len(), sharp.points.len() + 1);
        assert_eq!(cut(&[]).carriers, sharp.carriers);
        assert!(reach(&cut(&[failed])) > reach(&cut(&[])) + 0.05);
        assert_eq!(blunted(&sharp, 1.5, &[failed; 2]), None);
    }
}
