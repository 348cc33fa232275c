//! Insets of which parts are too narrow for two lanes side by side.
//!
//! Where a part is hardly wider than a bead, the inset is a strip of a few hundredths of a bead, or a row of slivers. Rounded to
//! the grid, their two sides touch. To drop them would leave the part bare; so the strip is made as wide as lanes need, and the slivers
//! are joined to one strip.

use crate::region::{dilation, inset, mitred_dilation, perimeter, ring_points, rings, signed_area};
use crate::spine::sides;
use argil_curve::SegmentIndex;
use geo::BooleanOps;
use geo_types::MultiPolygon;
use glam::DVec2;

/// Parts narrower than twice this, in w, are slender.
const SLENDER: f64 = 0.08;

/// How much slender parts grow on every side, in w: their lanes are then twice this apart, and no farther than this from where they
/// belong.
const GROWTH: f64 = 0.02;

/// Gaps up to twice this, in w, between slender parts are closed.
const GAP: f64 = 0.5;

/// How far the arcs that close gaps may cut their corners, in w.
const CLOSING_CHORD: f64 = 0.03;

/// Slender parts shorter round than this, in w, are the tips of corners and stay as they are.
const LEAST: f64 = 0.7;

/// What rounding leaves along the sides of other parts is not slender but nothing: it has no more area than this for each mm round it,
/// in w, …
const HAIR: f64 = 2e-4;

/// … and comes no farther than this from the others, in w.
const SHAVING: f64 = 0.01;

/// Spacing of the places where the wall is looked for, in w.
const STEP: f64 = 0.4;

/// A wall farther than this from its place, in w, is not there.
const MISSING: f64 = 0.06;

/// How much nearer than half a bead the outline may be to a place of the wall, in w: it was simplified by not quite as much.
pub(crate) const SLACK: f64 = 0.003;

/// Whether the wall is missing somewhere half a bead inside of the outline, where its place is as far as that from all of the outline.
///
/// # Complexity
/// O(n k) for n places, of which the k where there is no wall are held against the whole outline.
pub(crate) fn is_strip_lost(outline: &[Vec<DVec2>], wall: &SegmentIndex, width: f64) -> bool {
    let half = 0.5 * width;
    let mut whole: Option<SegmentIndex> = None;
    let mut fits = |place: DVec2| {
        let sides = || SegmentIndex::new(outline.iter().flat_map(|ring| sides(ring)).collect(), width);
        !whole.get_or_insert_with(sides).is_within(place, half - SLACK * width)
    };
    outline.iter().enumerate().any(|(number, ring)| {
        let inward = if (signed_area(ring) > 0.0) == (number == 0) { half } else { -half };
        sides(ring).any(|side| {
            let inward = inward * (side.end - side.start).normalize_or_zero().perp();
            let count = (side.length() / (STEP * width)).ceil().clamp(1.0, 1e6);
            (0..count as usize).any(|k| {
                let place = side.point_at((k as f64 + 0.5) / count) + inward;
                !wall.is_within(place, MISSING * width) && fits(place)
            })
        })
    })
}

/// The slender parts of a region, made wide enough for two lanes and joined where they follow one another.
///
/// # Complexity
/// That of a few offsets of the region.
pub(crate) fn strips(region: &MultiPolygon<f64>, width: f64, chord: f64) -> MultiPolygon<f64> {
    let stout = mitred_dilation(&inset(region, SLENDER * width, chord), SLENDER * width);
    let mut slender = region.difference(&stout);
    slender.0.retain(|part| perimeter(&ring_points(part.exterior())) >= LEAST * width);
    if slender.0.is_empty() {
        return slender;
    }
    let stout: Vec<Vec<DVec2>> = stout.iter().flat_map(rings).map(ring_points).collect();
    let stout = SegmentIndex::new(stout.iter().flat_map(|ring| sides(ring)).collect(), width);
    // One that leads from part to part has all its corners there, but not its sides.
    slender.0.retain(|part| {
        let ring = ring_points(part.exterior());
        let is_hair = signed_area(&ring).abs() <= HAIR * width * perimeter(&ring);
        !is_hair || sides(&ring).any(|side| !stout.is_within(side.point_at(0.5), SHAVING * width))
    });
    if slender.0.is_empty() {
        return slender;
    }
    // Arcs that are inset by their own radius fall together, and the fewer chords they have, the faster that is cleared.
    let coarse = CLOSING_CHORD * width;
    let closed = inset(&dilation(&slender, GAP * width, coarse), GAP * width, coarse);
    dilation(&closed.union(&slender), GROWTH * width, chord)
}

#[cfg(test)]
mod tests {
    use super::*;
    use geo_types::{Polygon, polygon};

    fn strips_of(outline: Polygon<f64>) -> MultiPolygon<f64> {
        strips(&inset(&MultiPolygon(vec![outline]), 1.491, 0.006), 3.0, 0.006)
    }

    #[test]
    fn a_strip_is_made_as_wide_as_two_lanes_need() {
        let bar = polygon![(x: 0.0, y: 0.0), (x: 30.0, y: 0.0), (x: 30.0, y: 3.1), (x: 0.0, y: 3.1)];
        let strips = strips_of(bar);
        assert_eq!(strips.0.len(), 1);
        let heights = ring_points(strips.0[0].exterior()).into_iter().map(|p| p.y);
        let (low, high) = heights.fold((f64::MAX, f64::MIN), |(low, high), y| (low.min(y), high.max(y)));
        assert!((high - low - 0.238).abs() < 0.01, "0.118 mm and twice 0.06: {low} {high}");
    }

    #[test]
    fn what_rounding_leaves_along_a_side_is_no_strip() {
        // Wide blocks on narrow feet, at places that the polygon kernel has to round.
        for k in 0..400 {
            let left = 2.0 + 0.0137 * f64::from(k);
            let block = polygon![
                (x: left, y: -7.0), (x: -12.0, y: -7.0), (x: -12.0, y: -10.0), (x: 12.0, y: -10.0),
                (x: 12.0, y: -7.0), (x: left + 8.0, y: -7.0), (x: left + 8.0, y: 10.0), (x: left, y: 10.0),
            ];
            let strips = strips_of(block);
            let tops = strips.iter().flat_map(|strip| ring_points(strip.exterior())).map(|p| p.y);
            let top = tops.fold(f64::MIN, f64::max);
            assert!((-9.0..0.0).contains(&top), "the foot is the only one: {strips:?}");
        }
    }
}
