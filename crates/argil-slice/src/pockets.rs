//! Pockets of solid that a spine shuts off from its wall.
//!
//! A loop round one could only be reached through the wall. One that is shallow is covered by the beads around it and filled; in one that is
//! deep the wall at its bottom would be missed, so that the spine is opened there.

use crate::containment::contains;
use crate::region::{beads, perimeter, ring_points, rings};
use crate::spine::sides;
use crate::thin::HALF_LANE;
use argil_curve::SegmentIndex;
use geo::{Area, BooleanOps, Intersects};
use geo_types::{LineString, MultiPolygon, Polygon};
use glam::DVec2;

/// Holes smaller than this, in w², are gaps between a spine and its wall.
const LEAST_HOLE: f64 = 0.01;

/// What lies within this of the other side of a spine, in w, lies beside the spine.
const BESIDE: f64 = 3.0 * HALF_LANE;

/// Pockets that are shorter round than this, in w, are covered by the beads around them. A loop of their own could only be reached
/// through the wall, with less than a bead along it.
const LEAST_POCKET: f64 = 2.0;

/// What of a pocket lies within this of a wall, in w, is that wall and no spine.
const ON_WALL: f64 = 0.01;

/// Where along the spine that shuts a pocket off it is opened, as shares of the spine's length, the widest first: all along, or so that
/// one of its ends or both still join the wall.
const MOUTHS: [[f64; 2]; 8] =
    [[0.0, 1.0], [0.0, 0.6], [0.4, 1.0], [0.0, 0.3], [0.35, 0.65], [0.7, 1.0], [0.2, 0.45], [0.55, 0.8]];

/// What a mouth cuts off and is smaller than this, in w², is half a bead of spine beside the wall.
const CRUMB: f64 = 0.02;

/// The region without holes that are gaps between a spine and its wall, or pockets that both shut off. `outline` has the rings of the
/// outline.
pub(crate) fn without_gaps(polygon: Polygon<f64>, outline: &[Vec<DVec2>], width: f64) -> Polygon<f64> {
    let outer = sides_of([polygon.exterior()], width);
    let (exterior, mut holes) = polygon.into_inner();
    holes.retain(|hole| !is_gap(hole, &outer, outline, width));
    Polygon::new(exterior, holes)
}

/// The region with its deep pockets open to the outside, where that leaves it in one piece. `walls` are those that spines were joined to.
pub(crate) fn with_bays(
    mut polygon: Polygon<f64>,
    walls: &MultiPolygon<f64>,
    outline: &[Vec<DVec2>],
    width: f64,
) -> Polygon<f64> {
    if polygon.interiors().is_empty() {
        return polygon;
    }
    let outer = sides_of([polygon.exterior()], width);
    let deep = |hole: &LineString<f64>| {
        let middles = sides(&ring_points(hole)).map(|side| side.point_at(0.5)).collect::<Vec<_>>();
        let depths = ring_points(hole).into_iter().chain(middles).filter_map(|p| outer.nearest(p));
        let depth = depths.map(|side| side.distance).fold(0.0, f64::max);
        (depth > BESIDE * width && is_gap(hole, &outer, outline, width)).then(|| (depth, hole.clone()))
    };
    let mut pockets: Vec<(f64, LineString<f64>)> = polygon.interiors().iter().filter_map(deep).collect();
    if pockets.is_empty() {
        return polygon;
    }
    pockets.sort_by(|a, b| b.0.total_cmp(&a.0));
    let walls: MultiPolygon<f64> = walls.iter().filter(|wall| wall.intersects(&polygon)).cloned().collect();
    let standing = sides_of(walls.iter().flat_map(rings), width);
    let is_spine = |p: DVec2| !standing.is_within(p, ON_WALL * width);
    for (_, pocket) in pockets {
        let spine = longest_run(&ring_points(&pocket), is_spine);
        let opened = |[from, to]: [f64; 2]| {
            let mouth = beads(&[stretch(&spine, from, to)], BESIDE * width, 0.1 * BESIDE * width);
            let mut opened = polygon.difference(&mouth).union(&walls);
            opened.0.retain(|part| part.unsigned_area() >= CRUMB * width * width);
            let only = opened.0.pop()?;
            opened.0.is_empty().then_some(only)
        };
        if let Some(opened) = MOUTHS.into_iter().find_map(opened) {
            polygon = opened;
        }
    }
    polygon
}

/// Whether a hole is a gap between a spine and its wall, or a pocket that both shut off.
fn is_gap(hole: &LineString<f64>, outer: &SegmentIndex, outline: &[Vec<DVec2>], width: f64) -> bool {
    let area = Polygon::new(hole.clone(), Vec::new()).unsigned_area();
    let points = ring_points(hole);
    let is_beside = || points.iter().all(|&p| outer.is_within(p, BESIDE * width));
    let is_pocket = || !outline.iter().any(|ring| contains(&points, ring[0]));
    let is_small = perimeter(&points) < LEAST_POCKET * width;
    area < LEAST_HOLE * width * width || is_beside() || (is_small && is_pocket())
}

fn sides_of<'a>(rings: impl IntoIterator<Item = &'a LineString<f64>>, width: f64) -> SegmentIndex {
    let rings: Vec<Vec<DVec2>> = rings.into_iter().map(ring_points).collect();
    SegmentIndex::new(rings.iter().flat_map(|ring| sides(ring)).collect(), width)
}

/// The longest run of a ring's vertices that are such, with the vertices before and after it. None where all or none are.
fn longest_run(ring: &[DVec2], is_such: impl Fn(DVec2) -> bool) -> Vec<DVec2> {
    let n = ring.len();
    let such: Vec<bool> = ring.iter().map(|&p| is_such(p)).collect();
    let firsts = (0..n).filter(|&k| such[k] && !such[(k + n - 1) % n]);
    let runs = firsts.map(|first| {
        let count = (0..n).take_while(|&k| such[(first + k) % n]).count();
        (0..count + 2).map(|k| ring[(first + n - 1 + k) % n]).collect::<Vec<_>>()
    });
    runs.max_by(|a, b| length(a).total_cmp(&length(b))).unwrap_or_default()
}

fn length(line: &[DVec2]) -> f64 {
    line.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
}

/// The part of a line from one share of its length to another.
fn stretch(line: &[DVec2], from: f64, to: f64) -> Vec<DVec2> {
    let whole = length(line);
    let (from, to) = (from * whole, to * whole);
    let mut done = 0.0;
    let mut part = Vec::new();
    for pair in line.windows(2) {
        let side = pair[0].distance(pair[1]);
        let at = |arc: f64| pair[0].lerp(pair[1], ((arc - done) / side).clamp(0.0, 1.0));
        if side > 0.0 && done + side >= from && done <= to {
            if part.is_empty() {
                part.push(at(from));
            }
            part.push(at(to));
        }
        done += side;
    }
    part
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::region::swept;
    use geo_types::Coord;

    fn rectangle(from: (f64, f64), to: (f64, f64)) -> Polygon<f64> {
        let corners = [from, (to.0, from.1), to, (from.0, to.1)];
        Polygon::new(LineString(corners.map(Coord::from).to_vec()), Vec::new())
    }

    /// A wall of 6 x 2 mm, and a spine of beads of 1 mm that comes from the left and passes over it at a height, down to it at both ends.
    fn with_pocket(height: f64) -> (Polygon<f64>, MultiPolygon<f64>) {
        let walls = MultiPolygon(vec![rectangle((0.0, -2.0), (6.0, 0.0))]);
        let top = height + HALF_LANE;
        let line = [(-4.0, 0.0), (2.8, -0.1), (2.9, top), (3.4, top), (3.5, -0.1)];
        let joined = walls.union(&swept(&[line.map(DVec2::from).to_vec()], HALF_LANE));
        assert_eq!(joined.0.len(), 1);
        (joined.0[0].clone(), walls)
    }

    fn outline() -> Vec<Vec<DVec2>> {
        vec![[(-5.0, -3.0), (7.0, -3.0), (7.0, 3.0), (-5.0, 3.0)].map(DVec2::from).to_vec()]
    }

    #[test]
    fn a_deep_pocket_is_opened_and_nothing_falls_off() {
        let (joined, walls) = with_pocket(0.2);
        assert_eq!(joined.interiors().len(), 1);
        let opened = with_bays(joined.clone(), &walls, &outline(), 1.0);
        assert_eq!(opened.interiors().len(), 0, "the pocket is a bay");
        let lost = joined.unsigned_area() - opened.unsigned_area();
        assert!(lost > 0.0 && lost < 0.1, "a bead's length of spine at most: {lost}");
        let wall = MultiPolygon(vec![opened]).intersection(&walls).unsigned_area();
        assert!((wall - 12.0).abs() < 1e-6, "the wall is whole: {wall}");
    }

    #[test]
    fn a_pocket_that_beads_cover_is_filled() {
        let (joined, walls) = with_pocket(0.0);
        let same = with_bays(joined.clone(), &walls, &outline(), 1.0);
        assert_eq!(same, joined);
        assert_eq!(without_gaps(same, &outline(), 1.0).interiors().len(), 0);
    }

    #[test]
    fn a_spine_that_alone_joins_two_parts_stays_shut() {
        let walls = MultiPolygon(vec![rectangle((0.0, -2.0), (6.0, 0.0)), rectangle((0.0, 5.0), (6.0, 7.0))]);
        let spine = [(3.0, 5.1), (3.0, 0.25), (2.8, 0.2), (2.7, -0.1)].map(DVec2::from).to_vec();
        let other = [(3.0, 0.25), (3.2, 0.2), (3.3, -0.1)].map(DVec2::from).to_vec();
        let joined = walls.union(&swept(&[spine, other], HALF_LANE));
        let opened = with_bays(joined.0[0].clone(), &walls, &outline(), 1.0);
        let together = walls.0.iter().all(|wall| wall.intersects(&opened));
        assert!(together, "one of the two ways is enough, but one there must be");
    }

    #[test]
    fn a_stretch_has_the_share_of_the_length() {
        let line = [(0.0, 0.0), (1.0, 0.0), (1.0, 3.0)].map(DVec2::from);
        assert_eq!(stretch(&line, 0.0, 1.0), line);
        assert_eq!(stretch(&line, 0.5, 0.75), [(1.0, 1.0), (1.0, 2.0)].map(DVec2::from));
        assert_eq!(stretch(&[], 0.0, 1.0), []);
    }

    #[test]
    fn the_longest_run_may_go_over_the_first_vertex() {
        let ring = [(0.0, 0.0), (4.0, 0.0), (4.0, 1.0), (4.0, 2.0), (0.0, 2.0), (0.0, 1.0)].map(DVec2::from);
        let run = longest_run(&ring, |p| p.x < 1.0 || p.y == 1.0);
        assert_eq!(run, [(4.0, 2.0), (0.0, 2.0), (0.0, 1.0), (0.0, 0.0), (4.0, 0.0)].map(DVec2::from));
        assert_eq!(longest_run(&ring, |_| true), []);
    }
}
