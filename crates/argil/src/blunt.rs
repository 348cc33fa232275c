//! Sharp turns of the free strand are cut: a nozzle that reverses on the spot heaps clay.

use argil_curve::DVec2;
use argil_route::Cycle;

/// Turns sharper than this are cut, degrees. The limit that is measured is 135°.
const SHARPEST: f64 = 125.0;
/// Length of the cut along each arm, in w.
const CUT: f64 = 0.08;
/// Least half width of the new tip, in w.
const TIP: f64 = 0.04;

/// Replaces the vertex of every sharp turn in a free stretch by two that stand across the tip. A vertex that carries
/// a demand hands it on to the first of them. Returns `None` where nothing is sharp.
pub(crate) fn blunted(cycle: &Cycle, width: f64) -> Option<Cycle> {
    let n = cycle.points.len();
    let mut out = Cycle { roots: cycle.roots, ..Cycle::default() };
    let mut place = Vec::with_capacity(n);
    let mut hit = false;
    for k in 0..n {
        let (before, here, after) =
            (cycle.points[(k + n - 1) % n], cycle.points[k], cycle.points[(k + 1) % n]);
        place.push(out.points.len());
        let mut push = |at: DVec2, fixed: bool| {
            out.points.push(at);
            out.fixed.push(fixed);
            out.legs.push(cycle.legs[k]);
        };
        match tip(before, here, after, width) {
            Some(ends) if !cycle.fixed[k] => {
                hit = true;
                ends.into_iter().for_each(|p| push(p, false));
            }
            _ => push(here, cycle.fixed[k]),
        }
    }
    out.carriers = cycle.carriers.iter().map(|&(k, demand)| (place[k], demand)).collect();
    hit.then_some(out)
}

/// The two vertices that cut a sharp turn, in the order of the walk.
fn tip(before: DVec2, here: DVec2, after: DVec2, width: f64) -> Option<[DVec2; 2]> {
    let (into, out) = (here - before, after - here);
    let (a, b) = (into.try_normalize()?, out.try_normalize()?);
    if a.angle_to(b).abs().to_degrees() < SHARPEST {
        return None;
    }
    let cut = (CUT * width).min(0.4 * into.length()).min(0.4 * out.length());
    let (p, q) = (here - cut * a, here + cut * b);
    // Across the tip, from the incoming arm to the outgoing one.
    let axis = (a - b).try_normalize()?;
    let across = if (q - p).dot(axis.perp()) >= 0.0 { axis.perp() } else { -axis.perp() };
    let half = (0.5 * (q - p).length()).max(TIP * width);
    Some([here - half * across, here + half * across])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reversal_becomes_two_right_angles() {
        let [p, q] = tip(DVec2::new(-2.0, 0.1), DVec2::ZERO, DVec2::new(-2.0, -0.1), 1.5).unwrap();
        assert!(p.y > 0.0 && q.y < 0.0, "{p} {q}: in the order of the walk");
        let turn = |a: DVec2, b: DVec2, c: DVec2| (b - a).angle_to(c - b).abs().to_degrees();
        assert!(turn(DVec2::new(-2.0, 0.1), p, q) < SHARPEST);
        assert!(turn(p, q, DVec2::new(-2.0, -0.1)) < SHARPEST);
    }

    #[test]
    fn a_gentle_turn_stays() {
        assert_eq!(tip(DVec2::new(-2.0, 0.0), DVec2::ZERO, DVec2::new(0.0, 2.0), 1.5), None);
    }
}
