//! Growing and shrinking regions, on top of `geo`.

use argil_curve::{DVec2, without_needles};
use geo::Buffer;
use geo::buffer::{BufferStyle, LineJoin};
use geo_types::{Coord, LineString, MultiPolygon, Polygon};

/// How far arcs may cut their corners, in w.
const CHORD: f64 = 0.006;

/// All points within `distance` of the region.
pub(crate) fn dilation(region: &impl Buffer<Scalar = f64>, distance: f64, width: f64) -> MultiPolygon<f64> {
    offset(region, distance, arc(distance, width))
}

/// The region inset by `distance`, without parts thinner than twice `slight`; corners stay sharp.
pub(crate) fn opened_inset(
    region: &impl Buffer<Scalar = f64>,
    distance: f64,
    slight: f64,
    width: f64,
) -> MultiPolygon<f64> {
    let inward = distance + slight;
    let shrunk = offset(region, -inward, arc(inward, width));
    // Needles without width would stay such, and the rings cross themselves there.
    let without = |ring: &LineString<f64>| -> Option<LineString<f64>> {
        let kept = without_needles(&ring_points(ring));
        (kept.len() >= 3).then(|| kept.into_iter().map(|p| Coord { x: p.x, y: p.y }).collect())
    };
    let whole = |polygon: &Polygon<f64>| {
        let exterior = without(polygon.exterior())?;
        Some(Polygon::new(exterior, polygon.interiors().iter().filter_map(without).collect()))
    };
    let shrunk = MultiPolygon(shrunk.iter().filter_map(whole).collect());
    if shrunk.0.is_empty() { shrunk } else { offset(&shrunk, slight, LineJoin::Miter(60_f64.to_radians())) }
}

fn offset(region: &impl Buffer<Scalar = f64>, distance: f64, join: LineJoin<f64>) -> MultiPolygon<f64> {
    region.buffer_with_style(BufferStyle::new(distance).line_join(join))
}

/// The kernel's chords span less than twice this angle, so that their sagitta is at most `CHORD` w.
fn arc(radius: f64, width: f64) -> LineJoin<f64> {
    LineJoin::Round((1.0 - (CHORD * width / radius).min(0.3)).acos())
}

/// The vertices of a ring without the repeated first.
pub(crate) fn ring_points(ring: &LineString<f64>) -> Vec<DVec2> {
    let mut points: Vec<DVec2> = ring.0.iter().map(|c| DVec2::new(c.x, c.y)).collect();
    if points.len() > 1 && points.first() == points.last() {
        points.pop();
    }
    points
}

/// The rings of a polygon, the exterior first.
pub(crate) fn rings(polygon: &Polygon<f64>) -> impl Iterator<Item = &LineString<f64>> {
    std::iter::once(polygon.exterior()).chain(polygon.interiors())
}
