//! The area that a bead sweeps: what is laid twice shows as length times width less that area.

use argil_curve::DVec2;
use geo::algorithm::buffer::{BufferStyle, LineCap, LineJoin};
use geo::{Area, Buffer, Coord, LineString, MultiLineString, MultiPolygon, Simplify};
use std::f64::consts::PI;

/// Pieces of about this many beads are swept one by one.
const PIECE: f64 = 6.0;

/// Round ends and joins have eight chords for half a circle. Each end is 2.6 % smaller than a true half disc,
/// and figures of doubled clay, small differences of large areas, show it: the number is a convention that
/// keeps them comparable. The sliver less keeps it at eight when it is computed as π over this angle.
const CHORD: f64 = PI / 8.0 * (1.0 - 1e-9);

/// In widths: how far the boundary of a region may be moved before it is swept, to rid it of points.
const SMOOTHING: f64 = 0.001;

/// Cosine of a turn after which a path runs back on itself.
const REVERSAL: f64 = -0.999;

/// Area in mm² of the bead of width `width` along a polyline, each place counted once.
pub(crate) fn swept_area(line: &[DVec2], width: f64) -> f64 {
    let style =
        BufferStyle::new(0.5 * width).line_join(LineJoin::Round(CHORD)).line_cap(LineCap::Round(CHORD));
    MultiLineString::new(pieces(line, PIECE * width)).buffer_with_style(style).unsigned_area()
}

/// The bead along the whole boundary of `region`: length times width, and the area swept, both in mm².
///
/// The area is what lies within half a bead of the boundary on either side. Two offsets of a region are much
/// cheaper than one of its rings when those have arcs of half a bead's radius, which sweeping shrinks to
/// points. Wall paths do: they go round concave corners so. The boundary is rid of needless points first;
/// length and area are both taken after that, since what counts is their small difference.
pub(crate) fn laid_and_swept(region: &MultiPolygon<f64>, width: f64) -> (f64, f64) {
    if region.0.is_empty() {
        return (0.0, 0.0);
    }
    let region = region.simplify(SMOOTHING * width);
    let rings = region.iter().flat_map(|p| std::iter::once(p.exterior()).chain(p.interiors()));
    let length: f64 = rings.flat_map(LineString::lines).map(|line| line.dx().hypot(line.dy())).sum();
    let offset = |by: f64| region.buffer_with_style(BufferStyle::new(by).line_join(LineJoin::Round(CHORD)));
    (length * width, offset(0.5 * width).unsigned_area() - offset(-0.5 * width).unsigned_area())
}

/// Cuts a polyline at the vertices where its length passes a multiple of `piece`, and where it turns back on
/// itself: there the kernel takes the arc cosine of what may be less than −1 by rounding, and the round join
/// gets lost. The ends of pieces are round as well.
fn pieces(points: &[DVec2], piece: f64) -> Vec<LineString<f64>> {
    let coord = |p: DVec2| Coord { x: p.x, y: p.y };
    let mut pieces = Vec::new();
    let mut current: Vec<Coord<f64>> = points.first().map(|&p| coord(p)).into_iter().collect();
    let (mut run, mut passed) = (0.0, 0.0);
    let mut heading = DVec2::ZERO;
    for pair in points.windows(2) {
        let step = pair[1] - pair[0];
        let turned_to = step.normalize_or(heading);
        if heading.dot(turned_to) < REVERSAL && current.len() > 1 {
            pieces.push(LineString::new(std::mem::replace(&mut current, vec![coord(pair[0])])));
        }
        heading = turned_to;
        current.push(coord(pair[1]));
        run += step.length();
        let reached = (run / piece).floor();
        if reached > passed {
            passed = reached;
            pieces.push(LineString::new(std::mem::replace(&mut current, vec![coord(pair[1])])));
        }
    }
    if current.len() > 1 {
        pieces.push(LineString::new(current));
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(points: &[(f64, f64)]) -> f64 {
        let points: Vec<DVec2> = points.iter().map(|&p| p.into()).collect();
        swept_area(&points, 1.5)
    }

    /// A regular polygon of sixteen corners and radius w/2: two round ends.
    const ENDS: f64 = 16.0 * 0.5 * 0.75 * 0.75 * 0.382_683_432_365_089_8;

    #[test]
    fn a_straight_bead_is_a_strip_with_two_ends() {
        assert!((area(&[(0.0, 0.0), (40.0, 0.0)]) - (60.0 + ENDS)).abs() < 1e-4);
        let pieces: Vec<(f64, f64)> = (0..=400).map(|k| (0.1 * f64::from(k), 0.0)).collect();
        assert!((area(&pieces) - (60.0 + ENDS)).abs() < 1e-4);
    }

    #[test]
    fn there_and_back_is_swept_once() {
        assert!((area(&[(0.0, 0.0), (40.0, 0.0), (0.0, 0.0)]) - (60.0 + ENDS)).abs() < 1e-4);
    }

    #[test]
    fn there_and_back_keeps_its_end_in_every_direction() {
        for k in 0..300 {
            let (s, c) = (0.02 * f64::from(k)).sin_cos();
            let tip = (0.75 + 4.0 * c, 0.75 + 4.0 * s);
            let swept = area(&[(0.75, 0.75), tip, (0.75, 0.75)]);
            assert!((swept - (6.0 + ENDS)).abs() < 1e-4, "{tip:?} {swept}");
        }
    }

    #[test]
    fn a_closed_loop_keeps_its_hole() {
        let ring: Vec<(f64, f64)> = (0..=256)
            .map(|k| (f64::from(k) * PI / 128.0).sin_cos())
            .map(|(s, c)| (15.0 * c, 15.0 * s))
            .collect();
        let exact = 2.0 * PI * 15.0 * 1.5;
        assert!((area(&ring) / exact - 1.0).abs() < 2e-3, "{} {exact}", area(&ring));
    }
}
