//! Fewer vertices for the same closed curve.

use crate::on_grid;
use glam::DVec2;

/// Sides that run back along each other at less than this angle, in radians, enclose nothing.
const NEEDLE: f64 = 1e-5;

/// Vertices no farther apart than this have no direction between them, mm: rounding of polygon kernels.
const SAME_PLACE: f64 = 1e-6;

/// A closed curve through some of the vertices, from which no vertex is farther than `tolerance` mm
/// (Douglas and Peucker, <https://doi.org/10.3138/FM57-6770-U75U-7727>).
///
/// Two vertices are kept in any case: the lowest leftmost, which is a corner of the hull, and the one farthest from it. So
/// the result does not depend on where the ring begins. It may cross itself where the ring comes within two tolerances of itself.
///
/// # Complexity
/// O(n log n) for most curves of n vertices, O(n²) at worst.
///
/// # Example
/// ```
/// use argil_curve::{DVec2, simplified};
/// let nearly_a_triangle = [(0.0, 0.0), (5.0, -0.01), (9.0, 0.0), (4.0, 6.0)].map(DVec2::from);
/// assert_eq!(simplified(&nearly_a_triangle, 0.1), [(0.0, 0.0), (9.0, 0.0), (4.0, 6.0)].map(DVec2::from));
/// ```
#[must_use]
pub fn simplified(ring: &[DVec2], tolerance: f64) -> Vec<DVec2> {
    let stays = staying(ring, tolerance);
    ring.iter().zip(stays).filter(|(_, stays)| *stays).map(|(p, _)| *p).collect()
}

/// The ring on the grid of the output, without the sides that are shorter than `least_side` mm there.
///
/// # Example
/// ```
/// use argil_curve::{DVec2, rounded};
/// let ring = [(0.000_01, 0.0), (4.0, 0.0), (4.0, 0.000_2), (0.0, 3.0), (0.0, 0.000_3)].map(DVec2::from);
/// assert_eq!(rounded(&ring, 1e-4, 1e-3), [(0.0, 0.0), (4.0, 0.0), (0.0, 3.0)].map(DVec2::from));
/// ```
#[must_use]
pub fn rounded(ring: &[DVec2], grid: f64, least_side: f64) -> Vec<DVec2> {
    let mut kept: Vec<DVec2> = Vec::with_capacity(ring.len());
    for &point in ring {
        let point = on_grid(point, grid);
        if kept.last().is_none_or(|last| last.distance(point) >= least_side) {
            kept.push(point);
        }
    }
    while kept.len() > 1 && kept[kept.len() - 1].distance(kept[0]) < least_side {
        kept.pop();
    }
    kept
}

/// The ring without the tips of needles that have no width: vertices at which it turns back along itself by an angle of less than 1e-5. Of vertices
/// that are no farther than 1e-6 mm from each other one is kept.
///
/// Polygon kernels leave such needles, and take the reversal for a reflex corner where rounding has it so.
///
/// # Complexity
/// O(n).
///
/// # Example
/// ```
/// use argil_curve::{DVec2, without_needles};
/// let ring = [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (9.0, 3.0), (2.0, 3.0), (0.0, 3.0)].map(DVec2::from);
/// assert_eq!(without_needles(&ring), [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (2.0, 3.0), (0.0, 3.0)].map(DVec2::from));
/// ```
#[must_use]
pub fn without_needles(ring: &[DVec2]) -> Vec<DVec2> {
    let is_tip = |[a, b, c]: [DVec2; 3]| {
        let (to, from) = (b - a, c - b);
        let back = -to.dot(from);
        back > 0.0 && to.perp_dot(from).abs() <= NEEDLE * back
    };
    let mut kept: Vec<DVec2> = Vec::with_capacity(ring.len());
    for &vertex in ring {
        if kept.last().is_some_and(|last| last.distance(vertex) <= SAME_PLACE) {
            continue;
        }
        kept.push(vertex);
        while let [.., a, b, c] = kept[..]
            && is_tip([a, b, c])
        {
            kept.truncate(kept.len() - 2);
            if a.distance(c) > SAME_PLACE {
                kept.push(c);
            }
        }
    }
    // Those where the ring begins.
    while let [first, second, .., before, last] = kept[..] {
        if last.distance(first) <= SAME_PLACE || is_tip([before, last, first]) {
            kept.pop();
        } else if is_tip([last, first, second]) {
            kept.remove(0);
        } else {
            break;
        }
    }
    kept
}

/// Which vertices stay.
fn staying(ring: &[DVec2], tolerance: f64) -> Vec<bool> {
    let count = ring.len();
    if count <= 3 {
        return vec![true; count];
    }
    let by_place =
        |&a: &usize, &b: &usize| ring[a].x.total_cmp(&ring[b].x).then(ring[a].y.total_cmp(&ring[b].y));
    let first = (0..count).min_by(by_place).unwrap_or(0);
    let from_first = |k: usize| ring[k].distance_squared(ring[first]);
    let second = (0..count).max_by(|&a, &b| from_first(a).total_cmp(&from_first(b))).unwrap_or(0);
    let mut stays = vec![false; count];
    stays[first] = true;
    stays[second] = true;
    // Spans of consecutive vertices as (begin, number of steps), cyclic.
    let steps = |from: usize, to: usize| (to + count - from) % count;
    let mut spans = vec![(first, steps(first, second)), (second, steps(second, first))];
    while let Some((begin, length)) = spans.pop() {
        let end = begin + length;
        let at = |k: usize| ring[if k < count { k } else { k - count }];
        let (from, side) = (at(begin), at(end) - at(begin));
        let squared = side.length_squared();
        let mut farthest = (tolerance, None);
        for k in begin + 1..end {
            let t = if squared > 0.0 { ((at(k) - from).dot(side) / squared).clamp(0.0, 1.0) } else { 0.0 };
            let away = at(k).distance(from + side * t);
            if away > farthest.0 {
                farthest = (away, Some(k));
            }
        }
        if let (_, Some(k)) = farthest {
            stays[k % count] = true;
            spans.push((begin, k - begin));
            spans.push((k % count, end - k));
        }
    }
    stays
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_vertex_is_farther_than_the_tolerance() {
        let at = |k: usize| DVec2::from_angle(k as f64 * 0.1) * (5.0 + (k as f64 * 0.7).sin());
        let ring: Vec<DVec2> = (0..62).map(at).collect();
        for tolerance in [0.0, 0.01, 0.3, 2.0, 50.0] {
            let simple = simplified(&ring, tolerance);
            let side = |k: usize| crate::Segment::new(simple[k], simple[(k + 1) % simple.len()]);
            for p in &ring {
                let off = (0..simple.len()).map(|k| side(k).distance(*p)).fold(f64::INFINITY, f64::min);
                assert!(off <= tolerance + 1e-12, "{off} of {tolerance}");
            }
            for turn in [1, 7, 40] {
                let mut turned = ring.clone();
                turned.rotate_left(turn);
                let (mut a, mut b) = (simple.clone(), simplified(&turned, tolerance));
                let by_place = |p: &DVec2, q: &DVec2| p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y));
                a.sort_by(by_place);
                b.sort_by(by_place);
                assert_eq!(a, b, "begun elsewhere");
            }
        }
    }

    #[test]
    fn odd_rings_stay() {
        assert!(simplified(&[], 1.0).is_empty());
        assert!(simplified(&[DVec2::ONE; 5], 1.0).iter().all(|&p| p == DVec2::ONE));
        assert!(simplified(&[DVec2::NAN, DVec2::ZERO, DVec2::ONE, DVec2::X], 1.0).len() <= 4);
        assert!(rounded(&[], 1e-4, 1.0).is_empty());
        let there_and_back = [DVec2::ZERO, DVec2::X, DVec2::X * 2.0, DVec2::X];
        assert!(without_needles(&there_and_back).len() <= 3, "nothing is left but a line");
    }

    #[test]
    fn a_needle_may_be_cut_in_pieces() {
        // On its way out and back it has vertices that rounding has put beside each other.
        let square = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)].map(DVec2::from);
        let needle = [
            (0.0, 2.0),
            (-3.0, 2.0),
            (-3.0 - 3e-8, 2.0 + 2e-8),
            (-9.0, 2.0),
            (-3.0, 2.0 - 3e-8),
            (-1e-8, 2.0),
        ];
        for turn in 0..10 {
            let mut ring: Vec<DVec2> = square.into_iter().chain(needle.map(DVec2::from)).collect();
            ring.rotate_left(turn);
            let whole = without_needles(&ring);
            assert!(whole.iter().all(|p| p.x > -1e-6), "begun at {turn}: {whole:?}");
            assert!(square.iter().all(|corner| whole.contains(corner)), "begun at {turn}: {whole:?}");
        }
    }
}
