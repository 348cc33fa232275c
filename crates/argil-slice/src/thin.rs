//! Walls that follow what is thinner than a bead.

use crate::containment::contains;
use crate::pockets::{with_bays, without_gaps};
use crate::region::{ring_points, rings, swept};
use argil_curve::{Segment, SegmentIndex};
use geo::BooleanOps;
use geo_types::{MultiPolygon, Polygon};
use glam::DVec2;

/// Half the distance between the two lanes of a spine, in w: far above the grid and the simplification, and so
/// little that both print one bead.
pub(crate) const HALF_LANE: f64 = 0.02;

/// Walls all of which lie within this of a spine, in w, are specks where the outline is just as wide as a bead: the spine runs through them.
const SPECK: f64 = 0.1;

/// Specks all of which lie within this of the spine, in w, are the same path as it.
const SAME: f64 = 0.035;

/// The region whose boundary runs along these walls and to both sides of each spine.
///
/// A spine that closes round a hole gives two loops side by side. Where nothing but the spine lies between them, the
/// inner one is left out, and the spine is printed once. `outline` has the rings of the outline.
pub(crate) fn with_spines(
    walls: &MultiPolygon<f64>,
    spines: &[Vec<DVec2>],
    outline: &[Vec<DVec2>],
    width: f64,
) -> MultiPolygon<f64> {
    let mut joined = walls.union(&swept(spines, HALF_LANE * width));
    let lines = spines.iter().flat_map(|spine| spine.windows(2));
    let lines = SegmentIndex::new(lines.map(|pair| Segment::new(pair[0], pair[1])).collect(), width);
    let is_beside = |polygon: &Polygon<f64>, reach: f64| {
        ring_points(polygon.exterior()).iter().all(|&p| lines.is_within(p, reach * width))
    };
    joined.0.retain(|polygon| !is_beside(polygon, SAME) || has_spine(polygon, spines));
    let is_speck = |polygon: &&Polygon<f64>| is_beside(polygon, SPECK) && !has_spine(polygon, spines);
    let ties: Vec<Vec<DVec2>> =
        joined.iter().filter(is_speck).filter_map(|speck| tie(speck, &lines, width)).collect();
    if !ties.is_empty() {
        joined = joined.union(&swept(&ties, HALF_LANE * width));
    }
    let opened = joined.into_iter().map(|polygon| with_bays(polygon, walls, outline, width));
    opened.map(|polygon| without_gaps(polygon, outline, width)).collect()
}

/// A short line from a spine into a speck beside it.
fn tie(speck: &Polygon<f64>, lines: &SegmentIndex, width: f64) -> Option<Vec<DVec2>> {
    let nearest = |p: DVec2| lines.nearest(p).map(|spine| (spine.distance, p, spine.point));
    let ring = ring_points(speck.exterior());
    let (distance, p, on_spine) = ring.into_iter().filter_map(nearest).min_by(|a, b| a.0.total_cmp(&b.0))?;
    let beyond = (p - on_spine) * (HALF_LANE * width / distance.max(f64::MIN_POSITIVE)).min(1.0);
    Some(vec![on_spine, p + beyond])
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
