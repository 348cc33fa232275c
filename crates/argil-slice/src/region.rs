//! The few polygon operations the slicer needs, on top of `geo`.

use geo::buffer::{BufferStyle, LineCap, LineJoin};
use geo::{Area, Buffer};
use geo_types::{Coord, LineString, MultiLineString, MultiPolygon, Polygon};
use glam::DVec2;
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::overlay::{FloatOverlay, OverlayOptions};

/// The region round which closed contours wind any number of times but none.
///
/// So bodies that overlap are one, cavities stay, and a mesh that is inside out (it winds −1 times) is as good as
/// another. Pieces of less than `least_area` are dropped.
pub(crate) fn wound_region(contours: &[Vec<DVec2>], least_area: f64) -> MultiPolygon<f64> {
    region_by(FillRule::NonZero, contours, least_area)
}

/// The region inside an odd number of contours, whichever way they run. Pieces of less than `least_area` are dropped.
pub(crate) fn parity_region(contours: &[Vec<DVec2>], least_area: f64) -> MultiPolygon<f64> {
    region_by(FillRule::EvenOdd, contours, least_area)
}

/// The region that a rule makes of contours.
///
/// Rings may touch themselves and each other: the kernel's other form, in which none does, takes what touches a hole
/// for a hole where contours run through one corner three times or along each other.
fn region_by(rule: FillRule, contours: &[Vec<DVec2>], least_area: f64) -> MultiPolygon<f64> {
    let rings: Vec<Vec<[f64; 2]>> = contours
        .iter()
        .filter(|ring| ring.len() >= 3)
        .map(|ring| ring.iter().map(DVec2::to_array).collect())
        .collect();
    let options = OverlayOptions { ogc: false, ..OverlayOptions::ogc() };
    let shapes = FloatOverlay::with_subj_custom(&rings, options, Default::default())
        .overlay(OverlayRule::Subject, rule);
    let polygon = |shape: &Vec<Vec<[f64; 2]>>| {
        let rings: Vec<Vec<DVec2>> =
            shape.iter().map(|ring| ring.iter().copied().map(DVec2::from).collect()).collect();
        polygon_through(&rings)
    };
    let mut region: MultiPolygon<f64> = shapes.iter().map(polygon).collect();
    region.0.retain(|polygon| polygon.unsigned_area() >= least_area);
    region
}

/// All points of the region farther than `distance` from its boundary, up to `chord_error`: joins
/// round concave corners are arcs of chords.
pub(crate) fn inset(
    region: &impl Buffer<Scalar = f64>,
    distance: f64,
    chord_error: f64,
) -> MultiPolygon<f64> {
    offset(region, -distance, arc_step(distance, chord_error))
}

/// All points within `distance` of the region, short by at most `chord_error`.
pub(crate) fn dilation(
    region: &impl Buffer<Scalar = f64>,
    distance: f64,
    chord_error: f64,
) -> MultiPolygon<f64> {
    offset(region, distance, arc_step(distance, chord_error))
}

/// Grows by moving the sides outwards and letting them meet in sharp corners, down to 60°; this
/// undoes a small inset without rounding the corners off. Sharper corners are cut, since where the
/// inset has eaten a short side the new corner sticks out of the original, at 60° by up to the distance.
pub(crate) fn mitred_dilation(region: &MultiPolygon<f64>, distance: f64) -> MultiPolygon<f64> {
    offset(region, distance, LineJoin::Miter(60_f64.to_radians()))
}

/// All points within about `distance` of the lines, whose ends are square.
pub(crate) fn swept(lines: &[Vec<DVec2>], distance: f64) -> MultiPolygon<f64> {
    let style = BufferStyle::new(distance).line_cap(LineCap::Square);
    line_strings(lines).buffer_with_style(style.line_join(LineJoin::Miter(60_f64.to_radians())))
}

/// All points within `distance` of the lines, short by at most `chord_error`.
pub(crate) fn beads(lines: &[Vec<DVec2>], distance: f64, chord_error: f64) -> MultiPolygon<f64> {
    offset(&line_strings(lines), distance, arc_step(distance, chord_error))
}

fn line_strings(lines: &[Vec<DVec2>]) -> MultiLineString<f64> {
    let line = |points: &Vec<DVec2>| LineString(points.iter().map(|p| Coord { x: p.x, y: p.y }).collect());
    MultiLineString(lines.iter().map(line).collect())
}

fn offset(region: &impl Buffer<Scalar = f64>, distance: f64, join: LineJoin<f64>) -> MultiPolygon<f64> {
    region.buffer_with_style(BufferStyle::new(distance).line_join(join))
}

/// The kernel divides a turn by this angle and rounds the count down, so that a chord spans
/// less than twice it: its sagitta is at most r (1 − cos step).
fn arc_step(radius: f64, chord_error: f64) -> LineJoin<f64> {
    LineJoin::Round((1.0 - (chord_error / radius).min(0.3)).acos())
}

/// The rings of a polygon, the exterior first.
pub(crate) fn rings(polygon: &Polygon<f64>) -> impl Iterator<Item = &LineString<f64>> {
    std::iter::once(polygon.exterior()).chain(polygon.interiors())
}

/// The vertices of a ring without the repeated first.
pub(crate) fn ring_points(ring: &LineString<f64>) -> Vec<DVec2> {
    let mut points: Vec<DVec2> = ring.0.iter().map(|c| DVec2::new(c.x, c.y)).collect();
    if points.len() > 1 && points.first() == points.last() {
        points.pop();
    }
    points
}

/// The polygon through these vertices, the exterior first.
pub(crate) fn polygon_through(rings: &[Vec<DVec2>]) -> Polygon<f64> {
    let ring = |points: &Vec<DVec2>| LineString(points.iter().map(|p| Coord { x: p.x, y: p.y }).collect());
    let mut rings = rings.iter().map(ring);
    Polygon::new(rings.next().unwrap_or(LineString(Vec::new())), rings.collect())
}

/// Twice the signed area would do for a sign, but the loops are compared by area as well.
pub(crate) fn signed_area(points: &[DVec2]) -> f64 {
    let Some(&origin) = points.first() else { return 0.0 };
    let fan = points.windows(2).map(|pair| (pair[0] - origin).perp_dot(pair[1] - origin));
    0.5 * fan.sum::<f64>()
}

/// Length of the closed curve through these points.
pub(crate) fn perimeter(points: &[DVec2]) -> f64 {
    let closing = match (points.first(), points.last()) {
        (Some(first), Some(last)) => first.distance(*last),
        _ => 0.0,
    };
    points.windows(2).map(|pair| pair[0].distance(pair[1])).sum::<f64>() + closing
}
