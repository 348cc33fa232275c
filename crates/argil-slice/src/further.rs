//! Walls beyond the first: their insets shrink to slivers before they vanish, and are wanted to the last.

use geo::{BooleanOps, Euclidean, Length};
use geo_types::{LineString, MultiPolygon, Polygon};

use crate::region::{dilation, inset, union};

/// Half the width that a sliver of an inset is given, in w: a loop there and back that stays apart from itself after
/// rounding, and still runs where it is wanted.
const SLIVER: f64 = 0.028;

/// Slivers whose boundary is shorter than this are corners that were cut by cleaning, in w.
const LEAST_BOUNDARY: f64 = 0.1;

/// An inset of this many grid steps less than asked for stands for it: where an outline is an even number of beads wide to
/// the last digit, rounding decides whether there is anything, and two people decide differently.
const STEPS: f64 = 2.0;

/// How far an inset may differ from its cleaned form, in w, before it is a sliver.
const CLEANED: f64 = 0.015;

/// The inset of an outline for a wall beyond the first: the cleaned form of it that is given, with
/// what cleaning has taken away wherever the inset is a sliver, widened to a loop.
pub(crate) fn with_slivers(
    polygon: &Polygon<f64>,
    distance: f64,
    cleaned: MultiPolygon<f64>,
    (width, grid, chord): (f64, f64, f64),
) -> MultiPolygon<f64> {
    let whole = inset(polygon, distance - STEPS * grid, chord);
    if boundary(&whole) - boundary(&cleaned) < LEAST_BOUNDARY * width {
        return cleaned;
    }
    let kept =
        if cleaned.0.is_empty() { cleaned.clone() } else { dilation(&cleaned, CLEANED * width, chord) };
    let mut slivers = whole.difference(&kept);
    slivers.0.retain(|part| boundary_of(part) >= LEAST_BOUNDARY * width);
    if slivers.0.is_empty() {
        return cleaned;
    }
    union(&cleaned, &dilation(&slivers, SLIVER * width, chord))
}

fn boundary(region: &MultiPolygon<f64>) -> f64 {
    region.iter().map(boundary_of).sum()
}

fn boundary_of(polygon: &Polygon<f64>) -> f64 {
    let length = |ring: &LineString<f64>| Euclidean.length(ring);
    length(polygon.exterior()) + polygon.interiors().iter().map(length).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::region::mitred_dilation;
    use geo::{Area, BoundingRect};
    use geo_types::Coord;

    /// The second wall of a bar at a bead of 1 mm.
    fn second_wall(width: f64) -> MultiPolygon<f64> {
        let corners = [(0.0, 0.0), (20.0, 0.0), (20.0, width), (0.0, width)];
        let bar = Polygon::new(LineString(corners.map(Coord::from).to_vec()), Vec::new());
        let cleaned = mitred_dilation(&inset(&bar, 1.51, 0.003), 0.01);
        with_slivers(&bar, 1.5, cleaned, (1.0, 1e-4, 0.003))
    }

    #[test]
    fn a_bar_three_beads_wide_has_a_second_wall_there_and_back() {
        for width in [2.9999, 3.0, 3.0001, 3.01] {
            let found = second_wall(width);
            assert_eq!(found.0.len(), 1, "{width} mm wide");
            let size = found.bounding_rect().expect("a loop has a size");
            assert!((size.width() - 17.0).abs() < 0.1 && size.height() < 0.1, "{width} mm wide: {size:?}");
        }
        assert!(second_wall(2.99).0.is_empty(), "what is too narrow by more than rounding has none");
    }

    #[test]
    fn what_is_wide_enough_stays_as_it_is() {
        let found = second_wall(5.0);
        assert!((found.unsigned_area() - 17.0 * 2.0).abs() < 1e-3);
    }
}
