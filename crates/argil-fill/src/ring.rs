//! Rings: closed paths one bead apart, before they are joined.

use argil_curve::{ClosedCurve, DVec2, SegmentIndex, rounded, self_crossings};
use geo::Simplify;
use geo_types::{Coord, LineString, Polygon};

use crate::FillError;
use crate::offset::{ring_points, rings};

/// A closed path of beads: a wall, or a ring of a fill.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Ring {
    /// Its vertices in mm, without repeating the first at the end.
    pub points: Vec<DVec2>,
    /// Which wall it is, counted from the outline; `None` for a ring of the fill.
    pub wall: Option<usize>,
}

/// What rings may be simplified by, in w. They are opened by more, so that they stay simple.
const TOLERANCE: f64 = 0.006;

/// A side shorter than this many grid steps has no direction left after rounding.
pub(crate) const LEAST_SIDE: f64 = 12.0;

/// The rings round a polygon, simplified and on the grid; those shorter than `least` mm are left out.
pub(crate) fn rings_round(polygon: &Polygon<f64>, width: f64, grid: f64, least: f64) -> Vec<Vec<DVec2>> {
    rings(polygon).filter_map(|ring| ring_on_grid(ring_points(ring), width, grid, least)).collect()
}

/// The ring through some points, simplified and on the grid, unless it is shorter than `least` mm.
pub(crate) fn ring_on_grid(points: Vec<DVec2>, width: f64, grid: f64, least: f64) -> Option<Vec<DVec2>> {
    let mut line: LineString<f64> = points.into_iter().map(|p| Coord { x: p.x, y: p.y }).collect();
    line.close();
    let points = rounded(&ring_points(&line.simplify(TOLERANCE * width)), grid, LEAST_SIDE * grid);
    (points.len() >= 3 && perimeter(&points) >= least).then_some(points)
}

/// Length of the closed path.
pub(crate) fn perimeter(points: &[DVec2]) -> f64 {
    let closing = points.first().zip(points.last()).map_or(0.0, |(first, last)| first.distance(*last));
    points.windows(2).map(|pair| pair[0].distance(pair[1])).sum::<f64>() + closing
}

/// Simplifies a ring that is needed for further offsets only.
pub(crate) fn plainer(polygon: &Polygon<f64>, tolerance: f64) -> Polygon<f64> {
    let plain = |ring: &LineString<f64>| {
        let simple = ring.simplify(tolerance);
        // The kernel may lose a ring that crosses itself.
        let is_usable = simple.0.len() >= 4 && self_crossings(&ring_points(&simple)).is_empty();
        if is_usable { simple } else { ring.clone() }
    };
    Polygon::new(plain(polygon.exterior()), polygon.interiors().iter().map(plain).collect())
}

/// A ring with what the search for joints asks of it.
#[derive(Debug)]
pub(crate) struct Track {
    pub(crate) curve: ClosedCurve,
    pub(crate) index: SegmentIndex,
    pub(crate) wall: Option<usize>,
    low: DVec2,
    high: DVec2,
}

/// A place on a track.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) arc: f64,
    pub(crate) at: DVec2,
}

impl Track {
    pub(crate) fn new(number: usize, ring: &Ring, width: f64) -> Result<Self, FillError> {
        let curve = ClosedCurve::new(ring.points.clone())
            .ok()
            .filter(|curve| curve.segment_count() > 2)
            .ok_or(FillError::Ring { ring: number })?;
        let index = SegmentIndex::of_curves([&curve], width);
        let points = curve.points().iter();
        let (low, high) =
            points.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), &p| (low.min(p), high.max(p)));
        Ok(Self { curve, index, wall: ring.wall, low, high })
    }

    pub(crate) fn place(&self, arc: f64) -> Place {
        Place { arc, at: self.curve.point_at(arc) }
    }

    /// The place nearest to `p`, if it is within `reach`.
    pub(crate) fn nearest(&self, p: DVec2, reach: f64) -> Option<Place> {
        let near = self.index.nearest_within(p, reach)?;
        Some(self.place_on(near.index, near.point))
    }

    /// A point of one of its segments.
    pub(crate) fn place_on(&self, segment: usize, at: DVec2) -> Place {
        Place { arc: self.curve.arc_of(segment) + self.curve.points()[segment].distance(at), at }
    }

    /// Direction at an arc, as the chord over `step` to either side.
    pub(crate) fn heading(&self, arc: f64, step: f64) -> DVec2 {
        (self.curve.point_at(arc + step) - self.curve.point_at(arc - step)).normalize_or_zero()
    }
    /// Whether the boxes come within `reach` of each other.
    pub(crate) fn may_reach(&self, other: &Self, reach: f64) -> bool {
        (self.low - reach).cmple(other.high).all() && (other.low - reach).cmple(self.high).all()
    }
}
