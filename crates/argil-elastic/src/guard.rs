//! What a step must not do: drive strands across each other or onto a wall.

use glam::DVec2;
use robust::{Coord, orient2d};

use crate::neighbours::{Neighbours, boxes_within, from_segment};
use crate::rod::Rod;

/// The closed polyline in mm as the candidate had it, against which steps are judged.
///
/// Judging against the candidate and not the last iterate needs no memory of pairs, and says what the caller
/// wants to know: nothing crosses or touches that did not before the relaxation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Guard<'a> {
    pub(crate) rod: &'a Rod,
    pub(crate) candidate: &'a [DVec2],
    /// Distance in mm below which a strand touches a wall.
    pub(crate) touch: f64,
}

impl Guard<'_> {
    /// Calls `found` with every two edges that cross or touch in `points` (mm) but not in the candidate.
    ///
    /// Near-linear in the number of edges, by the neighbour lists, which must cover `points`.
    pub(crate) fn offenders(
        &self,
        points: &[DVec2],
        neighbours: &Neighbours,
        mut found: impl FnMut(usize, usize),
    ) {
        for (place, &edge) in self.rod.edges.iter().enumerate() {
            let edge = edge as usize;
            let [a, b] = self.ends(points, edge);
            for &other in neighbours.crossable(place) {
                let other = other as usize;
                let [c, d] = self.ends(points, other);
                let reach = if self.may_touch(edge, other) { self.touch } else { 0.0 };
                if boxes_within(a, b, c, d, reach) && self.offends([a, b], [c, d], edge, other) {
                    found(edge, other);
                }
            }
        }
    }

    fn offends(&self, first: [DVec2; 2], second: [DVec2; 2], edge: usize, other: usize) -> bool {
        let before = || (self.ends(self.candidate, edge), self.ends(self.candidate, other));
        if cross(first, second) {
            let (a, b) = before();
            return !cross(a, b);
        }
        if self.may_touch(edge, other) && gap(first, second) < self.touch {
            let (a, b) = before();
            return gap(a, b) >= self.touch && !cross(a, b);
        }
        false
    }

    /// Only walls can be touched, and not the wall a strand has just left.
    fn may_touch(&self, edge: usize, other: usize) -> bool {
        !self.rod.edge_has_free_end(other) && self.rod.edges_apart(edge, other) > 2
    }

    fn ends(&self, points: &[DVec2], edge: usize) -> [DVec2; 2] {
        [points[edge], points[self.rod.next(edge)]]
    }
}

/// Whether two segments cross properly, each with its ends strictly on both sides of the other.
///
/// By exact orientation, so that the answer for points as printed is the answer an auditor finds.
fn cross([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}

/// Sign of the side of line `a`–`b` on which `p` lies.
fn side(a: DVec2, b: DVec2, p: DVec2) -> f64 {
    let coord = |v: DVec2| Coord { x: v.x, y: v.y };
    let turn = orient2d(coord(a), coord(b), coord(p));
    // Zero has a sign too, but no side.
    if turn == 0.0 { 0.0 } else { turn.signum() }
}

/// Distance between two segments that do not cross.
fn gap([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> f64 {
    [from_segment(a, c, d), from_segment(b, c, d), from_segment(c, a, b), from_segment(d, a, b)]
        .into_iter()
        .map(DVec2::length_squared)
        .fold(f64::INFINITY, f64::min)
        .sqrt()
}
