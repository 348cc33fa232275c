//! Walls beyond the first: their insets shrink to slivers before they vanish, and are wanted to the last.

use geo::{BooleanOps, Distance, Euclidean, Length};
use geo_types::{Coord, LineString, MultiPolygon, Point, Polygon};

use crate::region::{dilation, inset};

/// How much nearer to its outline a wall with slivers is laid, in w: enough for a loop there and back that stays apart from
/// itself after rounding, while it still runs where it is wanted.
const SLIVER: f64 = 0.024;

/// Slivers whose boundary is shorter than this are corners that were cut by cleaning, in w.
const LEAST_BOUNDARY: f64 = 0.1;

/// An inset of so much less than asked for stands for it, in w: the outline was simplified by 0.002 w, and round joins are
/// chords here and elsewhere, so that where an outline is an even number of beads wide nobody can say whether there is anything.
const SHORT: f64 = 0.006;

/// How far an inset may differ from its cleaned form, in w, before it is a sliver.
const CLEANED: f64 = 0.015;

/// The distance at which a wall beyond the first is laid that is wanted at `distance` from its outline, and of which `cleaned` is
/// what a loop can be laid round: a little less where the inset has slivers, so that they become loops there and back.
///
/// The whole wall gives way, and not the slivers alone: hidden inside, it may lie that much farther out, and a loop that
/// widens at one place only has corners that touch each other.
pub(crate) fn laid_distance(
    polygon: &Polygon<f64>,
    distance: f64,
    cleaned: &MultiPolygon<f64>,
    (width, chord): (f64, f64),
) -> f64 {
    let whole = inset(polygon, distance - SHORT * width, chord);
    if boundary(&whole) - boundary(cleaned) < LEAST_BOUNDARY * width {
        return distance;
    }
    let kept = if cleaned.0.is_empty() { cleaned.clone() } else { dilation(cleaned, CLEANED * width, chord) };
    // The kernel may leave a triangle just inside of the outline, where offset sides meet in one point of its grid.
    let deep = |c: &Coord<f64>| outline_distance(polygon, *c) > 0.95 * distance;
    let is_sliver = |part: &Polygon<f64>| {
        boundary_of(part) >= LEAST_BOUNDARY * width && part.exterior().coords().all(deep)
    };
    if whole.difference(&kept).iter().any(is_sliver) { distance - SLIVER * width } else { distance }
}

fn outline_distance(polygon: &Polygon<f64>, c: Coord<f64>) -> f64 {
    let rings = std::iter::once(polygon.exterior()).chain(polygon.interiors());
    rings.map(|ring| Euclidean.distance(&Point::from(c), ring)).fold(f64::INFINITY, f64::min)
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

    /// Where the second wall of a bar is laid at a bead of 1 mm, and what it goes round.
    fn second_wall(width: f64) -> (f64, MultiPolygon<f64>) {
        let corners = [(0.0, 0.0), (20.0, 0.0), (20.0, width), (0.0, width)];
        let bar = Polygon::new(LineString(corners.map(Coord::from).to_vec()), Vec::new());
        let cleaned = mitred_dilation(&inset(&bar, 1.51, 0.003), 0.01);
        let distance = laid_distance(&bar, 1.5, &cleaned, (1.0, 0.003));
        (distance, inset(&bar, distance, 0.003))
    }

    #[test]
    fn a_bar_three_beads_wide_has_a_second_wall_there_and_back() {
        for width in [2.999, 3.0, 3.0001, 3.01] {
            let (_, found) = second_wall(width);
            assert_eq!(found.0.len(), 1, "{width} mm wide");
            let size = found.bounding_rect().expect("a loop has a size");
            assert!(
                (size.width() - 17.0).abs() < 0.1 && (0.03..0.1).contains(&size.height()),
                "{width} mm wide: {size:?}"
            );
        }
        assert!(second_wall(2.98).1.0.is_empty(), "what is too narrow by more than rounding has none");
    }

    #[test]
    fn what_is_wide_enough_stays_as_it_is() {
        let (distance, found) = second_wall(5.0);
        assert!((distance - 1.5).abs() < 1e-12 && (found.unsigned_area() - 17.0 * 2.0).abs() < 1e-3);
    }
}
