//! Regions to fill.

use geo::{Area, BooleanOps, Buffer};
use geo_types::{Coord, LineString, MultiPolygon, Polygon};
use proptest::prelude::*;
use std::f64::consts::TAU;

/// A disc as a polygon of 48 corners.
pub(crate) fn disc(x: f64, y: f64, radius: f64) -> MultiPolygon<f64> {
    let corner = |k: usize| {
        let angle = k as f64 * TAU / 48.0;
        Coord { x: x + radius * angle.cos(), y: y + radius * angle.sin() }
    };
    MultiPolygon(vec![Polygon::new(LineString((0..48).map(corner).collect()), Vec::new())])
}

/// The ring between two circles about the origin.
pub(crate) fn annulus(inner: f64, outer: f64) -> MultiPolygon<f64> {
    disc(0.0, 0.0, outer).difference(&disc(0.0, 0.0, inner))
}

/// A rectangle with one corner at the origin.
pub(crate) fn strip(length: f64, width: f64) -> MultiPolygon<f64> {
    let corners = [(0.0, 0.0), (length, 0.0), (length, width), (0.0, width)];
    MultiPolygon(vec![Polygon::new(LineString(corners.map(Coord::from).to_vec()), Vec::new())])
}

/// A bar with round ends.
fn bar(from: (f64, f64), to: (f64, f64), half: f64) -> MultiPolygon<f64> {
    LineString(vec![Coord::from(from), Coord::from(to)]).buffer(half)
}

/// Discs and bars that may overlap, less other discs: islands, holes, necks and strips of any width, 1 to 90 mm across.
pub(crate) fn region() -> impl Strategy<Value = MultiPolygon<f64>> {
    let place = || (-1.0..1.0, -1.0..1.0);
    let discs = prop::collection::vec((place(), 0.1..0.5), 1..5);
    let bars = prop::collection::vec((place(), place(), 0.8..3.0), 0..4);
    let holes = prop::collection::vec((place(), 0.03..0.25), 0..4);
    (-0.7..3.8, discs, bars, holes)
        .prop_map(|(size, discs, bars, holes)| {
            // As many small regions as large ones: from 0.7 to 60 beads of 1.5 mm.
            let half = f64::exp(size);
            let at = |(x, y): (f64, f64)| (half * x, half * y);
            let discs = discs.into_iter().map(|((x, y), radius)| disc(half * x, half * y, half * radius));
            let bars = bars.into_iter().map(|(from, to, half)| bar(at(from), at(to), half));
            let solid = discs.chain(bars).fold(MultiPolygon(Vec::new()), |all, part| all.union(&part));
            holes
                .into_iter()
                .fold(solid, |all, ((x, y), r)| all.difference(&disc(half * x, half * y, half * r)))
        })
        .prop_filter("there is something to fill", |region| region.unsigned_area() > 1.0)
}

/// Squares, discs and other regular polygons, turned by any angle, 6 to 60 beads of 1.5 mm wide.
pub(crate) fn wide() -> impl Strategy<Value = MultiPolygon<f64>> {
    (4_usize..40, 4.5..45.0, 0.0..TAU).prop_map(|(sides, inscribed, turn)| {
        let radius = inscribed / (TAU / (2.0 * sides as f64)).cos();
        let corner = |k: usize| {
            let angle = turn + k as f64 * TAU / sides as f64;
            Coord { x: radius * angle.cos(), y: radius * angle.sin() }
        };
        MultiPolygon(vec![Polygon::new(LineString((0..sides).map(corner).collect()), Vec::new())])
    })
}

/// The share of a region that lies in parts from `thin` to `wide` mm wide.
pub(crate) fn share_of_strips(region: &MultiPolygon<f64>, thin: f64, wide: f64) -> f64 {
    let opened = |width: f64| match width {
        0.0 => region.unsigned_area(),
        _ => region.buffer(-0.5 * width).buffer(0.5 * width).unsigned_area(),
    };
    ((opened(thin) - opened(wide)) / region.unsigned_area()).max(0.0)
}
