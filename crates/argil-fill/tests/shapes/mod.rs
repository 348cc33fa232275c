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

/// Discs and bars that may overlap, less other discs: islands, holes, necks and strips of any width, 2 to 30 mm across.
pub(crate) fn region() -> impl Strategy<Value = MultiPolygon<f64>> {
    let place = || (-12.0..12.0, -12.0..12.0);
    let discs = prop::collection::vec((place(), 1.0..6.0), 1..5);
    let bars = prop::collection::vec((place(), place(), 0.8..3.0), 0..4);
    let holes = prop::collection::vec((place(), 0.4..3.0), 0..4);
    (discs, bars, holes)
        .prop_map(|(discs, bars, holes)| {
            let discs = discs.into_iter().map(|((x, y), radius)| disc(x, y, radius));
            let bars = bars.into_iter().map(|(from, to, half)| bar(from, to, half));
            let solid = discs.chain(bars).fold(MultiPolygon(Vec::new()), |all, part| all.union(&part));
            holes.into_iter().fold(solid, |all, ((x, y), radius)| all.difference(&disc(x, y, radius)))
        })
        .prop_filter("there is something to fill", |region| region.unsigned_area() > 4.0)
}
