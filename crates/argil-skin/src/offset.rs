//! Growing and shrinking regions, on top of `geo`.

use argil_curve::{DVec2, self_crossings};
use geo::buffer::{BufferStyle, LineJoin};
use geo::{Area, Buffer, Simplify};
use geo_types::{LineString, MultiPolygon, Polygon};

/// How far arcs may cut their corners, in w.
const CHORD: f64 = 0.006;

/// What a ring may be simplified by, in w.
const PLAINER: f64 = 0.004;

/// Pieces smaller than this are rounding errors of the polygon kernel, in w².
const LEAST_AREA: f64 = 1e-4;

/// The region grown by `distance`, or shrunk where it is negative.
pub(crate) fn grown(region: &MultiPolygon<f64>, distance: f64, width: f64) -> MultiPolygon<f64> {
    if region.0.is_empty() {
        return MultiPolygon(Vec::new());
    }
    // The kernel's chords span less than twice this angle, so that their sagitta is at most `CHORD` w.
    let step = (1.0 - (CHORD * width / distance.abs()).min(0.3)).acos();
    plainer(&region.buffer_with_style(BufferStyle::new(distance).line_join(LineJoin::Round(step))), width)
}

/// The vertices of a ring without the repeated first.
pub(crate) fn ring_points(ring: &LineString<f64>) -> Vec<DVec2> {
    ring.0.iter().skip(1).map(|c| DVec2::new(c.x, c.y)).collect()
}

/// The region without vertices that change nothing: the kernel's time grows with those that lie within an offset of each other.
pub(crate) fn plainer(region: &MultiPolygon<f64>, width: f64) -> MultiPolygon<f64> {
    let plain = |ring: &LineString<f64>| {
        let simple = ring.simplify(PLAINER * width);
        // The kernel may lose a ring that crosses itself.
        let is_usable = simple.0.len() >= 4 && self_crossings(&ring_points(&simple)).is_empty();
        if is_usable { simple } else { ring.clone() }
    };
    let polygon =
        |p: &Polygon<f64>| Polygon::new(plain(p.exterior()), p.interiors().iter().map(plain).collect());
    MultiPolygon(region.iter().map(polygon).collect())
}

/// The union of the discs of a radius that fit into the region: what is thinner is gone.
pub(crate) fn opened(region: &MultiPolygon<f64>, radius: f64, width: f64) -> MultiPolygon<f64> {
    grown(&grown(region, -radius, width), radius, width)
}

/// The region without pieces that are none.
pub(crate) fn cleaned(mut region: MultiPolygon<f64>, width: f64) -> MultiPolygon<f64> {
    region.0.retain(|polygon| polygon.unsigned_area() >= LEAST_AREA * width * width);
    region
}
