//! Which wall hangs on which: the cheapest tree that joins the walls of a region.

use argil_curve::{ClosedCurve, DVec2};

/// One wall's joint to the tree: a strand from another wall, or from support on the way to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Joint {
    /// The wall that is joined (index among the region's walls; 0 is the root and has no joint).
    pub(crate) wall: usize,
    /// The wall whose excursion reaches it.
    pub(crate) parent: usize,
    /// Where, along the joined wall.
    pub(crate) arc: f64,
}

/// The places where two walls come closest, as arcs along each, and their distance.
///
/// # Complexity
/// O(n · m) for n and m points.
pub(crate) fn closest(a: &ClosedCurve, b: &ClosedCurve) -> (f64, f64, f64) {
    let mut best = (f64::INFINITY, 0.0, 0.0);
    let (around_a, around_b) = (bounds(a), bounds(b));
    for (k, &p) in a.points().iter().enumerate() {
        if distance_from(around_b, p) >= best.0 {
            continue;
        }
        let near = b.nearest(p);
        if near.distance < best.0 {
            best = (near.distance, a.arc_of(k), near.s);
        }
    }
    for (k, &p) in b.points().iter().enumerate() {
        if distance_from(around_a, p) >= best.0 {
            continue;
        }
        let near = a.nearest(p);
        if near.distance < best.0 {
            best = (near.distance, near.s, b.arc_of(k));
        }
    }
    best
}

/// The upright box round a curve.
fn bounds(curve: &ClosedCurve) -> (DVec2, DVec2) {
    let first = curve.points()[0];
    curve.points().iter().fold((first, first), |(low, high), &p| (low.min(p), high.max(p)))
}

/// How far a point is from a box; 0 inside.
fn distance_from((low, high): (DVec2, DVec2), p: DVec2) -> f64 {
    p.distance(p.clamp(low, high))
}

/// What a hop between two demands costs when walls are joined.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reuse {
    /// Longest hop that is printed anyway, mm.
    pub(crate) reach: f64,
    /// The share of its length that it then counts.
    pub(crate) share: f64,
}

/// Joins all walls of a region to the first one.
///
/// The tree grows from the root: the wall with the cheapest chain of hops over demands is joined next, to
/// the wall at which its chain begins, and at the place nearest to the last hop of the chain. Short hops between demands
/// are nearly free, since strand has to be printed there in any case.
///
/// `to_wall[d][w]` is the distance of demand d from wall w.
///
/// # Complexity
/// O(walls · (walls + demands)²), and O(points²) for every pair of walls.
pub(crate) fn join_walls(
    walls: &[&ClosedCurve],
    demands: &[DVec2],
    to_wall: &[Vec<f64>],
    reuse: Reuse,
) -> Vec<Joint> {
    let (nw, nodes) = (walls.len(), walls.len() + demands.len());
    let mut between = vec![(0.0, 0.0, 0.0); nw * nw];
    for a in 0..nw {
        for b in a + 1..nw {
            let (distance, at_a, at_b) = closest(walls[a], walls[b]);
            between[a * nw + b] = (distance, at_a, at_b);
            between[b * nw + a] = (distance, at_b, at_a);
        }
    }
    let hop = |a: usize, b: usize| match (a < nw, b < nw) {
        (true, true) => between[a * nw + b].0,
        (true, false) => to_wall[b - nw][a],
        (false, true) => to_wall[a - nw][b],
        (false, false) => {
            let length = demands[a - nw].distance(demands[b - nw]);
            if length < reuse.reach { reuse.share * length } else { length }
        }
    };
    let mut joined = vec![false; nw];
    let mut joints = Vec::with_capacity(nw.saturating_sub(1));
    if nw > 0 {
        joined[0] = true;
    }
    while joints.len() + 1 < nw {
        let from = chain_from(&joined, nodes, &hop);
        let Some(nearest) =
            (0..nw).filter(|&w| !joined[w]).min_by(|&a, &b| from[a].0.total_cmp(&from[b].0).then(a.cmp(&b)))
        else {
            break;
        };
        // Walk the chain back; a wall that is met on the way is joined first.
        let (mut wall, mut last, mut at) = (nearest, from[nearest].1, from[nearest].1);
        while !(at < nw && joined[at]) {
            if at < nw {
                wall = at;
                last = from[at].1;
            }
            at = from[at].1;
        }
        let arc =
            if last < nw { between[wall * nw + last].1 } else { walls[wall].nearest(demands[last - nw]).s };
        joints.push(Joint { wall, parent: at, arc });
        joined[wall] = true;
    }
    joints
}

/// Cheapest chains from all joined walls: (cost, predecessor) of every node, by Dijkstra on the full graph.
fn chain_from(joined: &[bool], nodes: usize, hop: &impl Fn(usize, usize) -> f64) -> Vec<(f64, usize)> {
    let mut best: Vec<(f64, usize)> =
        (0..nodes).map(|k| (if joined.get(k) == Some(&true) { 0.0 } else { f64::INFINITY }, k)).collect();
    let mut done = vec![false; nodes];
    for _ in 0..nodes {
        let Some(k) =
            (0..nodes).filter(|&k| !done[k]).min_by(|&a, &b| best[a].0.total_cmp(&best[b].0).then(a.cmp(&b)))
        else {
            break;
        };
        done[k] = true;
        for next in 0..nodes {
            if !done[next] {
                let cost = best[k].0 + hop(k, next);
                if cost < best[next].0 {
                    best[next] = (cost, k);
                }
            }
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64) -> ClosedCurve {
        let corners = [(x, 0.0), (x + 2.0, 0.0), (x + 2.0, 2.0), (x, 2.0)];
        ClosedCurve::new(corners.iter().map(|&(x, y)| DVec2::new(x, y)).collect()).unwrap()
    }

    #[test]
    fn walls_in_a_row_are_joined_one_to_the_next() {
        let walls = [square(0.0), square(10.0), square(5.0)];
        let walls: Vec<&ClosedCurve> = walls.iter().collect();
        let joints = join_walls(&walls, &[], &[], Reuse { reach: 3.3, share: 0.3 });
        let pairs: Vec<(usize, usize)> = joints.iter().map(|j| (j.wall, j.parent)).collect();
        assert_eq!(pairs, [(2, 0), (1, 2)]);
    }

    #[test]
    fn a_chain_of_demands_decides_the_place() {
        let walls = [square(0.0), square(8.0)];
        let demands: Vec<DVec2> = (0..10).map(|k| DVec2::new(1.0 + f64::from(k), 4.0)).collect();
        let to_wall: Vec<Vec<f64>> =
            demands.iter().map(|&d| walls.iter().map(|w| w.nearest(d).distance).collect()).collect();
        let walls: Vec<&ClosedCurve> = walls.iter().collect();
        let joints = join_walls(&walls, &demands, &to_wall, Reuse { reach: 3.3, share: 0.3 });
        assert_eq!(joints.len(), 1);
        assert!(walls[1].point_at(joints[0].arc).y > 1.9, "the side that faces the demands");
    }
}
