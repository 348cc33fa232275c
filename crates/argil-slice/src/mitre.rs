//! Tips on the corners of walls: a bead that turns at half its width from a corner leaves the corner bare.

use crate::spine::sides;
use argil_curve::{SegmentIndex, on_grid};
use glam::DVec2;

/// How far from the wall's path, in w, clay reaches all the same: a bead gives a little.
pub(crate) const REACH: f64 = 0.56;

/// A tip stands out by at most this, in w: enough to bring a right angle within 0.64 w, and not so much that the
/// wall would be said to have left its place.
const LONGEST_TIP: f64 = 0.066;

/// How far before and after the corner the path leaves the wall, in w. Shorter is a sharper turn at the tip
/// (129° at a right angle), longer leaves the wall's own corner farther aside.
const BASE: f64 = 0.085;

/// The path turns at least by this at a corner that gets a tip, in radians: less leaves nothing bare.
const LEAST_TURN: f64 = 0.7;

/// Gives the corners of wall paths tips where an outline's vertex lies beyond the bead's reach, if they may have
/// one, and returns all sides of the paths.
///
/// Each ring runs with the solid on its left. Results lie on the grid.
///
/// # Complexity
/// One query for the nearest side for each vertex of the outline.
pub(crate) fn mitre(
    rings: &mut [&mut Vec<DVec2>],
    outline: &[Vec<DVec2>],
    may_have_tip: impl Fn(DVec2) -> bool,
    width: f64,
    grid: f64,
) -> SegmentIndex {
    let starts: Vec<(usize, usize)> = rings
        .iter()
        .enumerate()
        .flat_map(|(number, ring)| (0..ring.len()).map(move |k| (number, k)))
        .collect();
    let index = index_of(rings, width);
    let mut tips: Vec<Vec<(usize, f64)>> = vec![Vec::new(); rings.len()];
    for &vertex in outline.iter().flatten() {
        if index.is_within(vertex, REACH * width) {
            continue;
        }
        let Some(nearest) = index.nearest_within(vertex, 2.0 * width) else { continue };
        let (number, k) = starts[nearest.index];
        let after = (k + 1) % rings[number].len();
        let to = |k: usize| rings[number][k].distance(nearest.point);
        let k = if to(k) <= to(after) { k } else { after };
        if to(k) < 0.02 * width && may_have_tip(rings[number][k]) {
            tips[number].push((k, (nearest.distance - REACH * width).min(LONGEST_TIP * width)));
        }
    }
    let mut is_same = true;
    for (ring, mut tips) in rings.iter_mut().zip(tips).filter(|(_, tips)| !tips.is_empty()) {
        tips.sort_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)));
        tips.dedup_by_key(|tip| tip.0);
        **ring = with_tips(ring, &tips, BASE * width, grid);
        is_same = false;
    }
    if is_same { index } else { index_of(rings, width) }
}

fn index_of(rings: &[&mut Vec<DVec2>], width: f64) -> SegmentIndex {
    SegmentIndex::new(rings.iter().flat_map(|ring| sides(ring)).collect(), width)
}

fn with_tips(ring: &[DVec2], tips: &[(usize, f64)], base: f64, grid: f64) -> Vec<DVec2> {
    let on_grid = |p: DVec2| on_grid(p, grid);
    let count = ring.len();
    let mut result = Vec::with_capacity(count + 2 * tips.len());
    let mut tips = tips.iter().peekable();
    for (k, &corner) in ring.iter().enumerate() {
        let Some(&(_, length)) = tips.next_if(|tip| tip.0 == k) else {
            result.push(corner);
            continue;
        };
        let [before, after] = [ring[(k + count - 1) % count] - corner, ring[(k + 1) % count] - corner];
        let outwards = -(before.normalize_or_zero() + after.normalize_or_zero()).normalize_or_zero();
        let turn = (-before).angle_to(after);
        if turn < LEAST_TURN || outwards == DVec2::ZERO {
            result.push(corner);
            continue;
        }
        // A side so short that both its ends would move is left to run straight to the tip.
        if before.length() > 2.5 * base {
            result.push(on_grid(corner + before.normalize() * base));
        }
        result.push(on_grid(corner + outwards * length));
        if after.length() > 2.5 * base {
            result.push(on_grid(corner + after.normalize() * base));
        }
    }
    result
}
