//! Where a closed polyline crosses itself.

use crate::{PointIndex, Segment, SegmentIndex};
use glam::{DVec2, Vec2Swizzles};
use std::f64::consts::TAU;

/// Vertices no further apart than this are one place, mm: the grid of the printed output.
const SAME_PLACE: f64 = 1e-4;

/// A vertex whose next one is no further than this has no direction of its own and is passed over, mm.
const NO_DIRECTION: f64 = 1e-6;

/// Directions that differ by less than this are one, in radians: the strands then run along each other.
const SAME_DIRECTION: f64 = 1e-6;

/// Coordinates beyond this take no part: their squares overflow.
const LARGEST: f64 = 1e150;

/// A sweep that would meet more segments at a time than this, in the mean, is dearer than a grid.
const MOST_MET: f64 = 48.0;

/// A place where a closed polyline crosses itself.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Crossing {
    /// The lower index: of a segment (named by the vertex at which it begins) or of a vertex, by `kind`.
    pub first: usize,
    /// The higher index, of the same kind.
    pub second: usize,
    /// Where they cross, mm.
    pub point: DVec2,
    /// How they cross.
    pub kind: CrossingKind,
}

/// How a polyline crosses itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum CrossingKind {
    /// Two segments cross inside both of them.
    Proper,
    /// Two vertices coincide and the four ends of the strands through them alternate round the point.
    AtVertex,
}

/// All places where the closed polyline through `points` crosses itself, proper crossings first, then those
/// at vertices, each in the order of their indices.
///
/// Vertices coincide when they are no more than 1e-4 mm apart. Strands that touch without changing sides, or
/// run along each other, are no crossings; neither is a vertex on the middle of a segment. Points that are
/// not finite take no part.
///
/// # Complexity
/// Near-linear for points spread evenly, since only segments in the same cells of a grid are compared.
///
/// # Example
/// ```
/// use argil_curve::{Crossing, CrossingKind, DVec2, self_crossings};
/// let bow_tie = [(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 2.0)].map(DVec2::from);
/// let crossing = Crossing { first: 0, second: 2, point: DVec2::new(1.0, 1.0), kind: CrossingKind::Proper };
/// assert_eq!(self_crossings(&bow_tie), [crossing]);
/// ```
#[must_use]
pub fn self_crossings(points: &[DVec2]) -> Vec<Crossing> {
    let mut found = proper_crossings(points);
    found.extend(vertex_crossings(points));
    found
}

fn proper_crossings(points: &[DVec2]) -> Vec<Crossing> {
    let n = points.len();
    let segments: Vec<Segment> =
        (0..n).map(|k| Segment::new(points[k], points[if k + 1 < n { k + 1 } else { 0 }])).collect();
    let mut found = Vec::new();
    let mut test = |first: usize, second: usize| {
        let (first, second) = (first.min(second), first.max(second));
        if segments[first].crosses(&segments[second]) {
            let point = segments[first].meeting_point(&segments[second]);
            found.push(Crossing { first, second, point, kind: CrossingKind::Proper });
        }
    };
    if !overlapping_pairs(&segments, &mut test) {
        let index = SegmentIndex::new(segments.clone(), mean_step(points));
        for (first, segment) in segments.iter().enumerate() {
            index.for_each_near(*segment, 0.0, |second, _| {
                if second > first {
                    test(first, second);
                }
            });
        }
    }
    found.sort_by_key(|c| (c.first, c.second));
    found
}

/// Calls `visit` with every pair of segments whose upright boxes meet, by a line that sweeps along x or along y; `false`, and nothing
/// is visited, where it would meet many segments at a time, as in a plane full of long ones.
fn overlapping_pairs(segments: &[Segment], mut visit: impl FnMut(usize, usize)) -> bool {
    let usable = |s: &Segment| s.start.abs().max(s.end.abs()).max_element() <= LARGEST;
    let (mut low, mut high, mut along) = (DVec2::INFINITY, DVec2::NEG_INFINITY, DVec2::ZERO);
    for segment in segments.iter().filter(|s| usable(s)) {
        low = low.min(segment.start).min(segment.end);
        high = high.max(segment.start).max(segment.end);
        along += (segment.end - segment.start).abs();
    }
    // How many segments a line along y, or along x, meets in the mean.
    let met = along / (high - low).max(DVec2::splat(f64::MIN_POSITIVE));
    let by_x = met.x <= met.y;
    let met = if by_x { met.x } else { met.y };
    if met.is_nan() || met > MOST_MET {
        return false;
    }
    // Boxes with the axis of the sweep first.
    let turned = |p: DVec2| if by_x { p } else { p.yx() };
    let mut boxes: Vec<(DVec2, DVec2, u32)> = (0..)
        .zip(segments)
        .filter(|(_, s)| usable(s))
        .map(|(k, s)| (turned(s.start.min(s.end)), turned(s.start.max(s.end)), k))
        .collect();
    boxes.sort_unstable_by(|a, b| a.0.x.total_cmp(&b.0.x).then(a.2.cmp(&b.2)));
    let mut active: Vec<(DVec2, DVec2, u32)> = Vec::new();
    for here in boxes {
        let mut k = 0;
        while k < active.len() {
            let other = active[k];
            if other.1.x < here.0.x {
                active.swap_remove(k);
                continue;
            }
            if other.0.y <= here.1.y && here.0.y <= other.1.y {
                visit(other.2 as usize, here.2 as usize);
            }
            k += 1;
        }
        active.push(here);
    }
    true
}

fn vertex_crossings(points: &[DVec2]) -> Vec<Crossing> {
    let n = points.len();
    let kept: Vec<usize> =
        (0..n).filter(|&k| points[k].distance(points[(k + 1) % n]) > NO_DIRECTION).collect();
    let m = kept.len();
    if m < 4 {
        return Vec::new();
    }
    let at = |k: usize| points[kept[k % m]];
    // The nearest vertex of the strand that is not at the place of vertex i: from there it comes, or there it goes.
    let end = |i: usize, from: usize, step: usize| {
        let away = (1..m).map(|k| from + k * step).find(|&k| at(k).distance(at(i)) > SAME_PLACE);
        at(away.unwrap_or(from))
    };
    let ends = |i: usize, of: usize| [end(i, of, m - 1), end(i, of, 1)];
    let places: Vec<DVec2> = kept.iter().map(|&k| points[k]).collect();
    let index = PointIndex::new(&places, mean_step(points));
    let mut found = Vec::new();
    for i in 0..m {
        // A little more, since distances are compared below.
        index.for_each_within(Segment::new(at(i), at(i)), 1.001 * SAME_PLACE, |j| {
            let coincide = |i: usize, j: usize| at(i).distance(at(j)) <= SAME_PLACE;
            let neighbours = j <= i + 1 || j - i == m - 1;
            // Where a strand has several vertices at the place, the first of them stands for all.
            let told = neighbours || coincide(i, j + m - 1) || coincide(i + m - 1, j);
            if told || !coincide(i, j) {
                return;
            }
            if ends_alternate(at(i), ends(i, i), ends(i, j)) {
                let (first, second) = (kept[i], kept[j]);
                found.push(Crossing { first, second, point: at(i), kind: CrossingKind::AtVertex });
            }
        });
    }
    found.sort_by_key(|c| (c.first, c.second));
    found
}

/// Whether, going round `centre`, one end of the second strand lies between the ends of the first and the
/// other does not.
fn ends_alternate(centre: DVec2, first: [DVec2; 2], second: [DVec2; 2]) -> bool {
    let angle = |p: DVec2| (p - centre).to_angle();
    let start = angle(first[0]);
    let turn = |p: DVec2| (angle(p) - start).rem_euclid(TAU);
    let across = turn(first[1]);
    let [a, b] = second.map(turn);
    let along_each_other = [a, b].iter().any(|&end| {
        (end - across).abs() < SAME_DIRECTION || end < SAME_DIRECTION || TAU - end < SAME_DIRECTION
    });
    !along_each_other && (a < across) != (b < across)
}

/// A cell about as long as a segment keeps both the cells of a segment and the segments of a cell few.
fn mean_step(points: &[DVec2]) -> f64 {
    let n = points.len();
    let total: f64 = (0..n).map(|k| points[k].distance(points[(k + 1) % n])).filter(|d| d.is_finite()).sum();
    total / n.max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn crossings(points: &[(f64, f64)]) -> Vec<(usize, usize, CrossingKind)> {
        let points: Vec<DVec2> = points.iter().map(|&p| p.into()).collect();
        self_crossings(&points).iter().map(|c| (c.first, c.second, c.kind)).collect()
    }

    #[test]
    fn a_crossing_at_a_shared_vertex() {
        let eight = [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0), (2.0, 2.0), (1.0, 1.0), (0.0, 2.0)];
        assert!(crossings(&eight).is_empty(), "two triangles that touch at their tips do not cross");
        let eight = [(0.0, 0.0), (1.0, 1.0), (2.0, 2.0), (2.0, 0.0), (1.0, 1.0), (0.0, 2.0)];
        assert_eq!(crossings(&eight), [(1, 4, CrossingKind::AtVertex)]);
    }

    #[test]
    fn a_strand_may_have_several_vertices_at_one_place() {
        // Down and up again from the right, past a strand that comes from the left; its vertex is there twice.
        let beside =
            [(2.0, -0.1), (0.0, 0.0), (-0.2, -2.0), (-2.0, 0.5), (-1e-4, 0.0), (0.0, 0.0), (2.0, 0.1)];
        assert!(crossings(&beside).is_empty(), "they touch");
        let [mut across, mut first, mut second] = [beside, beside, beside];
        (across[0].1, across[6].1) = (0.1, -0.1);
        assert_eq!(crossings(&across), [(1, 4, CrossingKind::AtVertex)], "once");
        (first[4], second[4]) = ((5e-5, 5e-5), (0.0, 1e-4));
        assert_eq!((crossings(&first), crossings(&second)), (vec![], vec![]));
    }

    #[test]
    fn there_and_back_is_no_crossing() {
        assert!(
            crossings(&[(0.0, 0.0), (1.0, 0.0), (2.0, 1.0), (3.0, 0.0), (2.0, 1.0), (1.0, 0.0)]).is_empty()
        );
    }

    #[test]
    fn odd_input_crosses_nothing() {
        assert!(crossings(&[]).is_empty());
        assert!(crossings(&[(1.0, 1.0); 5]).is_empty());
        assert!(crossings(&[(0.0, 0.0), (f64::NAN, 2.0), (2.0, 0.0), (0.0, 2.0)]).is_empty());
    }
}
