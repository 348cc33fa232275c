//! A region grown by next to nothing: each ring by itself, without a polygon kernel.

use crate::region::{polygon_through, ring_points, rings};
use crate::soundness::unsound;
use geo_types::MultiPolygon;
use glam::DVec2;

/// Sides that turn by less than this, as a sine, have no meeting point to speak of.
const PARALLEL: f64 = 1e-6;

/// Cosine between the normals of sides at a corner of 60°: sharper ones are left to the kernel, which cuts them.
const SHARPEST: f64 = -0.5;

/// How often sides that vanish are looked for: one that goes may take its neighbours along.
const ROUNDS: usize = 8;

/// Rings nearer than twenty of these, in units of the distance, are not told apart from such that touch.
const FINE: f64 = 1e-5;

/// The region grown by moving its sides outwards by `distance` and letting them meet in corners, if no parts of it meet each other by
/// that, nothing but short sides vanishes, and no corner is sharper than 60°; `None` otherwise.
///
/// # Complexity
/// Near linear in the vertices, as [`unsound`].
pub(crate) fn widened(region: &MultiPolygon<f64>, distance: f64) -> Option<MultiPolygon<f64>> {
    let mut wider: Vec<Vec<DVec2>> = Vec::new();
    for ring in region.iter().flat_map(rings) {
        wider.push(shifted(&ring_points(ring), distance)?);
    }
    if unsound(&wider, FINE * distance).contains(&true) {
        return None;
    }
    let mut wider = wider.into_iter();
    let parts = region.iter().map(|part| wider.by_ref().take(1 + part.interiors().len()).collect::<Vec<_>>());
    Some(MultiPolygon(parts.map(|rings| polygon_through(&rings)).collect()))
}

/// A side of a ring, moved outwards.
#[derive(Clone, Copy)]
struct Line {
    /// Its direction and the way outwards, of length 1.
    along: DVec2,
    out: DVec2,
    /// Where it begins in the ring, and where moved.
    start: DVec2,
    moved: DVec2,
}

/// A ring with the solid on its left whose sides have moved to the right.
fn shifted(ring: &[DVec2], distance: f64) -> Option<Vec<DVec2>> {
    let n = ring.len();
    let mut lines: Vec<Line> = (0..n)
        .map(|k| {
            let along = (ring[(k + 1) % n] - ring[k]).normalize_or_zero();
            let out = -along.perp();
            Line { along, out, start: ring[k], moved: ring[k] + distance * out }
        })
        .collect();
    if lines.iter().any(|line| line.along == DVec2::ZERO) {
        return None;
    }
    for _ in 0..ROUNDS {
        let count = lines.len();
        if count < 3 {
            return None;
        }
        let corner = |k: usize| meeting(&lines[(k + count - 1) % count], &lines[k], distance);
        let corners: Vec<DVec2> = (0..count).map(corner).collect::<Option<_>>()?;
        let vanishes = |k: usize| (corners[(k + 1) % count] - corners[k]).dot(lines[k].along) <= 0.0;
        let kept: Vec<Line> = (0..count).filter(|&k| !vanishes(k)).map(|k| lines[k]).collect();
        if kept.len() == count {
            return Some(corners);
        }
        lines = kept;
    }
    None
}

/// Where two sides meet that follow each other.
fn meeting(before: &Line, after: &Line, distance: f64) -> Option<DVec2> {
    if before.out.dot(after.out) < SHARPEST {
        return None;
    }
    let sine = before.along.perp_dot(after.along);
    if sine.abs() < PARALLEL {
        // In one line up to rounding, or a side between them has vanished.
        let aside = before.out.dot(after.start - before.start).abs();
        return (aside <= FINE * distance).then_some(after.moved);
    }
    let share = (after.moved - before.moved).perp_dot(after.along) / sine;
    Some(before.moved + share * before.along)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::region::polygon_through;
    use geo::Area;

    fn region(rings: &[&[(f64, f64)]]) -> MultiPolygon<f64> {
        let ring = |points: &&[(f64, f64)]| points.iter().map(|&p| DVec2::from(p)).collect::<Vec<_>>();
        MultiPolygon(vec![polygon_through(&rings.iter().map(ring).collect::<Vec<_>>())])
    }

    #[test]
    fn a_frame_gets_wider_on_both_sides() {
        let outer = [(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)];
        let hole = [(3.0, 3.0), (3.0, 6.0), (6.0, 6.0), (6.0, 3.0)];
        let wider = widened(&region(&[&outer, &hole]), 0.5).unwrap();
        assert!((wider.unsigned_area() - (100.0 - 4.0)).abs() < 1e-9);
    }

    #[test]
    fn a_short_side_in_a_notch_vanishes() {
        let notched = [(0.0, 0.0), (4.0, 2.0), (4.001, 2.0), (8.0, 0.0), (8.0, 9.0), (0.0, 9.0)];
        let wider = widened(&region(&[&notched]), 0.01).unwrap();
        assert_eq!(wider.0[0].exterior().0.len(), 6);
    }

    #[test]
    fn what_would_meet_or_is_sharp_is_left_to_others() {
        let slit = [
            (0.0, 0.0),
            (4.0, 0.0),
            (4.0, 5.0),
            (4.01, 5.0),
            (4.01, 0.0),
            (9.0, 0.0),
            (9.0, 9.0),
            (0.0, 9.0),
        ];
        assert_eq!(widened(&region(&[&slit]), 0.1), None);
        let spike = [(0.0, 0.0), (9.0, 0.0), (0.0, 1.0)];
        assert_eq!(widened(&region(&[&spike]), 0.1), None);
    }
}
