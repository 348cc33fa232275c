use crate::layer::WallLoop;
use crate::region::signed_area;
use glam::DVec2;

/// Fills in `parent` and `depth` of loops that are simple and pairwise disjoint.
///
/// Disjoint loops contain all of each other or nothing, so one vertex decides. A loop is contained
/// only in larger ones; the smallest of these is its parent and all others contain the parent.
///
/// # Complexity
/// Each loop is tested against the larger ones whose box it lies in.
pub(crate) fn nest(loops: &mut [WallLoop]) {
    let areas: Vec<f64> = loops.iter().map(|wall| signed_area(&wall.points).abs()).collect();
    let boxes: Vec<(DVec2, DVec2)> = loops.iter().map(|wall| bounds(&wall.points)).collect();
    let mut largest_first: Vec<usize> = (0..loops.len()).collect();
    largest_first.sort_by(|&a, &b| areas[b].total_cmp(&areas[a]).then(a.cmp(&b)));
    for (rank, &inner) in largest_first.iter().enumerate() {
        let Some(&point) = loops[inner].points.first() else { continue };
        let holds = |&&outer: &&usize| {
            let (low, high) = boxes[outer];
            point.cmpge(low).all() && point.cmple(high).all() && contains(&loops[outer].points, point)
        };
        let parent = largest_first[..rank].iter().rev().find(holds).copied();
        loops[inner].parent = parent;
        loops[inner].depth = parent.map_or(0, |outer| loops[outer].depth + 1);
    }
}

fn bounds(points: &[DVec2]) -> (DVec2, DVec2) {
    points.iter().fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), &p| (low.min(p), high.max(p)))
}

/// Whether a ray from the point to the right leaves the loop an odd number of times.
pub(crate) fn contains(points: &[DVec2], point: DVec2) -> bool {
    let mut inside = false;
    let mut from = points.last().copied().unwrap_or_default();
    for &to in points {
        if (from.y > point.y) != (to.y > point.y) {
            let x = from.x + (to.x - from.x) * (point.y - from.y) / (to.y - from.y);
            inside ^= x > point.x;
        }
        from = to;
    }
    inside
}
