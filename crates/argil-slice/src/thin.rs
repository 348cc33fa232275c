//! Walls that follow what is thinner than a bead.

use crate::containment::contains;
use crate::region::{perimeter, polygon_through, ring_points, rings, swept};
use crate::spine::sides;
use argil_curve::{Segment, SegmentIndex};
use geo::{Area, BooleanOps};
use geo_types::{LineString, MultiPolygon, Polygon};
use glam::DVec2;

/// Half the distance between the two lanes of a spine, in w: far above the grid and the simplification, and so
/// little that both print one bead.
pub(crate) const HALF_LANE: f64 = 0.02;

/// Walls all of which lie within this of a spine, in w, are specks where the outline is just as wide as a bead.
const SPECK: f64 = 0.1;

/// Holes smaller than this, in w², are gaps between a spine and its wall.
const LEAST_HOLE: f64 = 0.01;

/// Half the length of spine that is taken out where it shuts off solid, in w: just enough to keep the ends apart. All of what lay
/// within reach of the spine stays within reach.
const HALF_GAP: f64 = 0.06;

/// Holes longer round than this, in w, have room for strand to run along the wall on their inside.
const POCKET: f64 = 3.0;

/// The region whose boundary runs along these walls and to both sides of each spine. `outline` has the rings of the outline.
///
/// A spine that closes round a hole gives two loops side by side. Where nothing but the spine lies between them, the
/// inner one is left out, and the spine is printed once. Where a spine happens to meet a wall twice with little but solid
/// between, it is cut, so that no loop runs round a pocket that strand could only get to through the wall.
pub(crate) fn with_spines(
    walls: &MultiPolygon<f64>,
    spines: &[Vec<DVec2>],
    outline: &[Vec<DVec2>],
    width: f64,
) -> MultiPolygon<f64> {
    let mut joined = walls.union(&swept(spines, HALF_LANE * width));
    // One at a time: a spine between two pockets that is cut for both would lose the piece between.
    for _ in 0..joined.iter().map(|polygon| polygon.interiors().len()).sum() {
        let Some(at) = cut_at_pocket(&joined, walls, spines, outline, width) else { break };
        joined = joined.difference(&MultiPolygon(vec![disc(at, HALF_GAP * width)]));
    }
    let lines = spines.iter().flat_map(|spine| spine.windows(2));
    let lines = SegmentIndex::new(lines.map(|pair| Segment::new(pair[0], pair[1])).collect(), width);
    joined.0.retain(|polygon| {
        let ring = ring_points(polygon.exterior());
        let is_beside = || ring.iter().all(|&p| lines.nearest_within(p, SPECK * width).is_some());
        has_spine(polygon, spines) || !is_beside()
    });
    for polygon in &mut joined {
        let outer = SegmentIndex::new(sides(&ring_points(polygon.exterior())).collect(), width);
        let near = 3.0 * HALF_LANE * width;
        let stays = |hole: &LineString<f64>| {
            let area = Polygon::new(hole.clone(), Vec::new()).unsigned_area();
            let is_beside = || ring_points(hole).iter().all(|&p| outer.nearest_within(p, near).is_some());
            area >= LEAST_HOLE * width * width && !is_beside()
        };
        let holes = polygon.interiors().iter().filter(|hole| stays(hole)).cloned().collect();
        *polygon = Polygon::new(polygon.exterior().clone(), holes);
    }
    joined
}

/// For the first small hole of the region round which there is a spine, but in which there is no hole of the outline, the place of that spine
/// that is farthest from the walls.
fn cut_at_pocket(
    joined: &MultiPolygon<f64>,
    walls: &MultiPolygon<f64>,
    spines: &[Vec<DVec2>],
    outline: &[Vec<DVec2>],
    width: f64,
) -> Option<DVec2> {
    let walls = walls.iter().flat_map(rings).flat_map(|ring| sides(&ring_points(ring)).collect::<Vec<_>>());
    let walls = SegmentIndex::new(walls.collect(), width);
    let holes = joined.iter().flat_map(Polygon::interiors).map(ring_points);
    let small = holes.filter(|hole| perimeter(hole) < POCKET * width);
    let mut pockets = small.filter(|hole| !outline.iter().any(|ring| contains(hole, ring[0])));
    let cut = |pocket: Vec<DVec2>| {
        let sides = SegmentIndex::new(sides(&pocket).collect(), width);
        let beside = |p: &DVec2| sides.nearest_within(*p, 2.0 * HALF_LANE * width).is_some();
        let places = spines.iter().flatten().copied().filter(beside);
        let rated = places.map(|p| (walls.nearest(p).map_or(f64::INFINITY, |near| near.distance), p));
        let (distance, place) = rated.max_by(|a, b| a.0.total_cmp(&b.0))?;
        (distance > HALF_GAP * width).then_some(place)
    };
    pockets.find_map(cut)
}

/// A disc with few corners.
fn disc(centre: DVec2, radius: f64) -> Polygon<f64> {
    let corner = |k: u32| centre + radius * DVec2::from_angle(f64::from(k) * std::f64::consts::FRAC_PI_4);
    polygon_through(&[(0..8).map(corner).collect()])
}

/// Whether the region has one of the spines in it.
pub(crate) fn has_spine(region: &Polygon<f64>, spines: &[Vec<DVec2>]) -> bool {
    let rings: Vec<Vec<DVec2>> = rings(region).map(ring_points).collect();
    let holds = |p: DVec2| rings.iter().filter(|ring| contains(ring, p)).count() % 2 == 1;
    spines.iter().any(|spine| holds(middle(spine)))
}

/// A point half way along, by vertices or by the only segment.
pub(crate) fn middle(line: &[DVec2]) -> DVec2 {
    let k = line.len() / 2;
    line[k.saturating_sub(1)].midpoint(line[k])
}
