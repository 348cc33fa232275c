//! Sharp turns of the free strand are cut: a nozzle that reverses on the spot heaps clay.

use argil_curve::DVec2;
use argil_route::{Cycle, Leg};

/// Turns sharper than this are cut, degrees. The limit that is measured is 135°.
const SHARPEST: f64 = 125.0;
/// Length of the cut along each arm, in w.
const CUT: f64 = 0.08;
/// Least half width of the new tip, in w.
const TIP: f64 = 0.04;

/// How far beyond the turn the new tip lies, in w.
const OUT: f64 = 0.03;
/// Length of the step half way between a wall and the strand that leaves it, in w.
const STEP: f64 = 0.12;
/// How far a place that has to stay as it is spares the turns round it, in w.
const SPARE: f64 = 1.3;

/// Replaces the vertex of every sharp turn in a free stretch by two that stand across the tip, and where strand leaves or joins a wall in
/// a sharp turn, has it set out, or arrive, half way between. A vertex that carries a demand hands it on to the first of the two.
/// Turns near a `spared` place stay. Returns `None` where nothing is sharp.
pub(crate) fn blunted(cycle: &Cycle, width: f64, spared: &[DVec2]) -> Option<Cycle> {
    let n = cycle.points.len();
    let mut out = Cycle { roots: cycle.roots, ..Cycle::default() };
    let mut place = Vec::with_capacity(n);
    let mut hit = false;
    for k in 0..n {
        let before = (k + n - 1) % n;
        let [from, here, to] = [before, k, (k + 1) % n].map(|j| cycle.points[j]);
        let mut push = |at: DVec2, fixed: bool, leg: Leg| {
            out.points.push(at);
            out.fixed.push(fixed);
            out.legs.push(leg);
            out.points.len() - 1
        };
        let [arriving, leaving] = [cycle.legs[before], cycle.legs[k]];
        let is_sharp = turn(from, here, to).is_some_and(|turn| turn.abs().to_degrees() >= SHARPEST)
            && !spared.iter().any(|p| p.distance(here) < SPARE * width);
        let joins = [arriving, leaving].map(|leg| leg == Leg::Wall);
        hit |= is_sharp && (!cycle.fixed[k] || joins[0] != joins[1]);
        place.push(match (cycle.fixed[k], joins) {
            (false, _) if is_sharp => {
                let [p, q] = tip(from, here, to, width);
                let first = push(p, false, leaving);
                push(q, false, leaving);
                first
            }
            (true, [true, false]) if is_sharp => {
                let at = push(here, true, leaving);
                push(here + halfway(from, here, to, (to - here).length(), width), false, leaving);
                at
            }
            (true, [false, true]) if is_sharp => {
                push(here - halfway(from, here, to, (here - from).length(), width), false, arriving);
                push(here, true, leaving)
            }
            (fixed, _) => push(here, fixed, leaving),
        });
    }
    out.carriers = cycle.carriers.iter().map(|&(k, demand)| (place[k], demand)).collect();
    hit.then_some(out)
}

/// The angle by which a path turns at `here`, in radians.
fn turn(from: DVec2, here: DVec2, to: DVec2) -> Option<f64> {
    Some((here - from).try_normalize()?.angle_to((to - here).try_normalize()?))
}

/// A short step that turns by half of what the path turns at `here`; `free` is the length of the free arm.
fn halfway(from: DVec2, here: DVec2, to: DVec2, free: f64, width: f64) -> DVec2 {
    let half = turn(from, here, to).unwrap_or_default() / 2.0;
    DVec2::from_angle(half).rotate((here - from).normalize_or_zero()) * (STEP * width).min(0.4 * free)
}

/// The two vertices that cut a sharp turn, in the order of the walk: a little farther out than the turn, lest the cut hold less than it did.
fn tip(from: DVec2, here: DVec2, to: DVec2, width: f64) -> [DVec2; 2] {
    let (into, out) = (here - from, to - here);
    let (a, b) = (into.normalize_or_zero(), out.normalize_or_zero());
    let cut = (CUT * width).min(0.4 * into.length()).min(0.4 * out.length());
    let (p, q) = (here - cut * a, here + cut * b);
    // Across the tip, from the incoming arm to the outgoing one.
    let axis = (a - b).normalize_or(a);
    let across = if (q - p).dot(axis.perp()) >= 0.0 { axis.perp() } else { -axis.perp() };
    let half = (0.5 * (q - p).length()).max(TIP * width);
    let outwards = here + OUT * width * axis;
    [outwards - half * across, outwards + half * across]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cycle whose first `fixed` vertices are a wall.
    fn cycle(points: &[(f64, f64)], fixed: usize) -> Cycle {
        let n = points.len();
        let leg = |k: usize| if k + 1 < fixed { Leg::Wall } else { Leg::Support };
        Cycle {
            points: points.iter().map(|&p| DVec2::from(p)).collect(),
            fixed: (0..n).map(|k| k < fixed).collect(),
            legs: (0..n).map(leg).collect(),
            carriers: Vec::new(),
            roots: 0,
        }
    }

    fn sharpest(cycle: &Cycle) -> f64 {
        let n = cycle.points.len();
        let at = |k: usize| cycle.points[k % n];
        let turns = (0..n).filter_map(|k| turn(at(k), at(k + 1), at(k + 2)));
        turns.map(|turn| turn.abs().to_degrees()).fold(0.0, f64::max)
    }

    #[test]
    fn a_reversal_becomes_two_right_angles() {
        let [p, q] = tip(DVec2::new(-2.0, 0.1), DVec2::ZERO, DVec2::new(-2.0, -0.1), 1.5);
        assert!(p.y > 0.0 && q.y < 0.0, "{p} {q}: in the order of the walk");
        let turn = |a: DVec2, b: DVec2, c: DVec2| (b - a).angle_to(c - b).abs().to_degrees();
        assert!(turn(DVec2::new(-2.0, 0.1), p, q) < SHARPEST);
        assert!(turn(p, q, DVec2::new(-2.0, -0.1)) < SHARPEST);
    }

    #[test]
    fn a_gentle_turn_stays() {
        let square = cycle(&[(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)], 0);
        assert_eq!(blunted(&square, 1.5, &[]), None);
    }

    #[test]
    fn strand_leaves_and_joins_a_wall_in_two_turns() {
        let back = cycle(&[(0.0, 0.0), (4.0, 0.0), (1.5, 0.3), (-1.0, 3.0), (-3.0, 0.4), (3.0, -1.0)], 2);
        assert!(sharpest(&back) > 135.0);
        let blunt = blunted(&back, 1.5, &[]).unwrap();
        assert!(sharpest(&blunt) < SHARPEST, "{:?}", blunt.points);
        let fixed = |c: &Cycle| {
            c.points.iter().zip(&c.fixed).filter(|(_, f)| **f).map(|(p, _)| *p).collect::<Vec<_>>()
        };
        assert_eq!(fixed(&blunt), fixed(&back));
        assert_eq!(blunt.legs.iter().filter(|leg| **leg == Leg::Wall).count(), 1);
    }

    #[test]
    fn turns_near_a_spared_place_stay() {
        let sharp = cycle(&[(0.0, 0.0), (9.0, 0.0), (0.0, 0.5), (-2.0, 2.0), (-3.0, 0.2)], 0);
        assert_eq!(blunted(&sharp, 1.5, &[]).unwrap().points.len(), sharp.points.len() + 1);
        assert_eq!(blunted(&sharp, 1.5, &[DVec2::new(9.0, 1.0)]), None);
    }
}
