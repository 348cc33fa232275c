//! The few polygon operations the slicer needs, on top of `geo`.

use geo::bool_ops::FillRule;
use geo::buffer::{BufferStyle, LineCap, LineJoin};
use geo::{Area, BooleanOps, Buffer, OpType};
use geo_types::{Coord, LineString, MultiLineString, MultiPolygon, Polygon};
use glam::DVec2;

/// Contours that meet in a corner are drawn apart by this share of the way to its neighbours.
const APART: f64 = 1e-6;

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

fn region_by(rule: FillRule, contours: &[Vec<DVec2>], least_area: f64) -> MultiPolygon<f64> {
    let mut loops: Vec<Vec<DVec2>> = contours.iter().filter(|ring| ring.len() >= 3).cloned().collect();
    part(&mut loops);
    let loops = MultiPolygon(loops.iter().map(|ring| polygon_through(std::slice::from_ref(ring))).collect());
    let mut region = loops.boolean_op_with_fill_rule(&MultiPolygon(Vec::new()), OpType::Union, rule);
    region.0.retain(|polygon| polygon.unsigned_area() >= least_area);
    region
}

/// Draws contours apart that meet in one corner, three or more: the kernel can take what touches a hole there for holes.
///
/// All but the first turn off before the corner, by as little as the kernel still tells.
fn part(loops: &mut [Vec<DVec2>]) {
    let key = |p: &DVec2| [p.x.to_bits(), p.y.to_bits()];
    let mut corners: Vec<([u64; 2], usize, usize)> = Vec::new();
    for (ring, points) in loops.iter().enumerate() {
        corners.extend(points.iter().enumerate().map(|(k, p)| (key(p), ring, k)));
    }
    corners.sort_unstable();
    for meeting in corners.chunk_by(|a, b| a.0 == b.0).filter(|meeting| meeting.len() > 2) {
        for &(_, ring, k) in &meeting[1..] {
            let points = &mut loops[ring];
            let [before, after] = [points.len() - 1, 1].map(|step| points[(k + step) % points.len()]);
            points[k] = points[k].lerp(before.midpoint(after), APART);
        }
    }
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
