//! The largest disc that fits into a polygon.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use argil_curve::{DVec2, Segment};
use geo_types::Polygon;

use crate::offset::{ring_points, rings};

/// A square that may hold the centre.
#[derive(Clone, Copy, Debug)]
struct Cell {
    centre: DVec2,
    half: f64,
    /// Radius of the disc at its centre; negative outside of the polygon.
    radius: f64,
}

impl Cell {
    /// No disc with its centre in this cell is larger.
    fn bound(&self) -> f64 {
        self.radius + self.half * std::f64::consts::SQRT_2
    }
}

impl PartialEq for Cell {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Cell {}

impl PartialOrd for Cell {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Cell {
    fn cmp(&self, other: &Self) -> Ordering {
        let place = other.centre.x.total_cmp(&self.centre.x).then(other.centre.y.total_cmp(&self.centre.y));
        self.bound().total_cmp(&other.bound()).then(place)
    }
}

/// Cells looked at before the best disc so far is taken.
const BUDGET: usize = 4000;

/// The radius of the largest disc inside the polygon, up to `tolerance` (mm), or the radius of some disc that is no smaller than
/// `enough`; 0 for a polygon without inside.
///
/// Squares that could hold a better centre are divided, the most promising first.
///
/// # Complexity
/// O(cells · vertices), a few dozen cells for compact shapes and some hundred for long ones.
pub(crate) fn inscribed_radius(polygon: &Polygon<f64>, tolerance: f64, enough: f64) -> f64 {
    let sides: Vec<Segment> = rings(polygon)
        .flat_map(|ring| {
            let points = ring_points(ring);
            (0..points.len())
                .map(|k| Segment::new(points[k], points[(k + 1) % points.len()]))
                .collect::<Vec<_>>()
        })
        .collect();
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for side in &sides {
        (low, high) = (low.min(side.start), high.max(side.start));
    }
    let extent = high - low;
    if !(extent.min_element() > 0.0 && extent.is_finite() && tolerance > 0.0) {
        return 0.0;
    }
    let size = extent.min_element().max(extent.max_element() / 256.0);
    let half = 0.5 * size;
    let cell = |centre: DVec2, half: f64| Cell { centre, half, radius: signed_distance(&sides, centre) };
    let mut heap = BinaryHeap::new();
    let count = (extent / size).ceil();
    for row in 0..count.y as u32 {
        for column in 0..count.x as u32 {
            let corner = low + size * DVec2::new(f64::from(column), f64::from(row));
            heap.push(cell(corner + half, half));
        }
    }
    let mut best = 0.0_f64;
    for _ in 0..BUDGET {
        let Some(top) = heap.pop() else { break };
        best = best.max(top.radius);
        if best >= enough || top.bound() <= best + tolerance {
            break;
        }
        let half = 0.5 * top.half;
        for corner in [DVec2::new(-1.0, -1.0), DVec2::new(1.0, -1.0), DVec2::new(-1.0, 1.0), DVec2::ONE] {
            heap.push(cell(top.centre + half * corner, half));
        }
    }
    best
}

/// Distance to the nearest side, negative outside.
fn signed_distance(sides: &[Segment], p: DVec2) -> f64 {
    let mut inside = false;
    let mut nearest = f64::INFINITY;
    for side in sides {
        nearest = nearest.min(side.distance(p));
        let (from, to) = (side.start, side.end);
        if (from.y > p.y) != (to.y > p.y) {
            inside ^= from.x + (to.x - from.x) * (p.y - from.y) / (to.y - from.y) > p.x;
        }
    }
    if inside { nearest } else { -nearest }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geo_types::{Coord, LineString};

    fn polygon(corners: &[(f64, f64)]) -> Polygon<f64> {
        Polygon::new(LineString(corners.iter().map(|&(x, y)| Coord { x, y }).collect()), Vec::new())
    }

    #[test]
    fn of_a_square_a_strip_and_a_triangle() {
        let square = polygon(&[(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]);
        assert!((inscribed_radius(&square, 1e-3, 9.0) - 1.0).abs() < 2e-3);
        let strip = polygon(&[(0.0, 0.0), (40.0, 0.0), (40.0, 0.6), (0.0, 0.6)]);
        assert!((inscribed_radius(&strip, 1e-3, 9.0) - 0.3).abs() < 2e-3);
        let triangle = polygon(&[(0.0, 0.0), (4.0, 0.0), (0.0, 3.0)]);
        assert!((inscribed_radius(&triangle, 1e-3, 9.0) - 1.0).abs() < 2e-3);
    }

    #[test]
    fn of_nothing() {
        assert_eq!(
            inscribed_radius(&polygon(&[(0.0, 0.0), (1.0, 0.0)]), 1e-3, 9.0).to_bits(),
            0.0_f64.to_bits()
        );
    }
}
