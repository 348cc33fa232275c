//! Contours that wind round something otherwise than once.

use crate::layer::Loss;
use crate::region::signed_area;
use argil_curve::DVec2;
use geo::{Area, Contains};
use geo_types::{Coord, MultiPolygon, Point};

/// Share of w² up to which an area is a matter of rounding, or of a crumpled surface.
const NOTHING: f64 = 0.1;

/// The most vertices that are looked at for a place.
const MOST_PLACES: usize = 256;

/// What a layer's contours enclose more than once, or the wrong way round.
///
/// The signed areas of the contours add up to the area of the outline if they wind once round all of it. They come to more where bodies
/// overlap, and to less where a surface is inside out: there, what is solid in one body may be a hole through another.
pub(crate) fn unlike_one(
    layer: usize,
    contours: &[Vec<DVec2>],
    outline: &MultiPolygon<f64>,
    width: f64,
) -> Option<Loss> {
    let signed: f64 = contours.iter().map(|contour| signed_area(contour)).sum();
    let excess = signed - outline.unsigned_area();
    if excess.abs() <= NOTHING * width * width {
        return None;
    }
    let at = place(contours, outline)?;
    Some(if excess > 0.0 {
        Loss::Overlap { layer, at, area: excess }
    } else {
        // What winds −1 times counts once with each sign.
        Loss::InsideOut { layer, at, area: -0.5 * excess }
    })
}

/// A vertex that is no corner of the outline, if there is one among those that are looked at.
fn place(contours: &[Vec<DVec2>], outline: &MultiPolygon<f64>) -> Option<DVec2> {
    let count = contours.iter().map(Vec::len).sum::<usize>();
    let vertices = || contours.iter().flatten().copied();
    let inside = vertices()
        .step_by(count.div_ceil(MOST_PLACES).max(1))
        .find(|p| outline.contains(&Point(Coord { x: p.x, y: p.y })));
    inside.or(vertices().next())
}
