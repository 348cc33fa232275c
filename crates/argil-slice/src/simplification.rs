//! Fewer vertices for the same curve, after Douglas and Peucker,
//! <https://doi.org/10.3138/FM57-6770-U75U-7727>.

use argil_curve::on_grid;
use glam::DVec2;

/// A closed curve through some of the vertices, from which no vertex is farther than `tolerance`.
///
/// The result may cross itself where the ring comes within two tolerances of itself.
pub(crate) fn simplified(ring: &[DVec2], tolerance: f64) -> Vec<DVec2> {
    thinned(ring, tolerance).into_iter().map(|index| ring[index]).collect()
}

/// The ring on the grid of the output, without the sides that are shorter than `least_side`.
pub(crate) fn rounded(ring: &[DVec2], grid: f64, least_side: f64) -> Vec<DVec2> {
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

/// The indices that stay, rising. Two anchors are kept in any case: the lowest leftmost vertex, which is a
/// corner of the hull, and the one farthest from it, so that the result does not depend on where
/// the ring begins.
fn thinned(ring: &[DVec2], tolerance: f64) -> Vec<usize> {
    let count = ring.len();
    if count <= 3 {
        return (0..count).collect();
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
        let (from, to) = (ring[begin], ring[(begin + length) % count]);
        let mut farthest = (tolerance, 0);
        for step in 1..length {
            let distance = distance_to_side(ring[(begin + step) % count], from, to);
            if distance > farthest.0 {
                farthest = (distance, step);
            }
        }
        let (_, step) = farthest;
        if step > 0 {
            stays[(begin + step) % count] = true;
            spans.push((begin, step));
            spans.push(((begin + step) % count, length - step));
        }
    }
    (0..count).filter(|&k| stays[k]).collect()
}

/// Distance from a point to the segment between two others.
pub(crate) fn distance_to_side(point: DVec2, from: DVec2, to: DVec2) -> f64 {
    let side = to - from;
    let length_squared = side.length_squared();
    if length_squared == 0.0 {
        return point.distance(from);
    }
    let t = ((point - from).dot(side) / length_squared).clamp(0.0, 1.0);
    point.distance(from + side * t)
}
