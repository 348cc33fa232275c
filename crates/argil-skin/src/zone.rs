//! Which part of which layer is filled.

use argil_fill::FillError;
use geo::BooleanOps;
use geo_types::MultiPolygon;

use crate::SkinOptions;
use crate::offset::{cleaned, grown, opened, plainer};

/// A face that juts out by less than this beyond its neighbour is covered by the bead of the wall, in w.
const FACE: f64 = 1.0;

/// How far a zone reaches in under what covers it, in w: no gap shows from above or below where the two meet.
const UNDER: f64 = 0.25;

/// What of each layer's outline is to be filled, bottom first.
///
/// A layer is open above where the layer above it is not solid, and open below where the layer below is not; the lowest
/// and the highest have nothing beyond them. Where such a face is wider than a bead it is closed, with the
/// [`skin`](SkinOptions::skin) − 1 layers behind it. The [`floor`](SkinOptions::floor) lowest layers are closed whole.
///
/// A zone reaches a little in under what covers it, and out to the outline: what of it the walls cover is left to them by
/// [`Section::filled`](crate::Section::filled).
///
/// # Errors
/// [`FillError::Option`] for a width that is none.
///
/// # Complexity
/// Near linear in the vertices of the outlines, times the layers of a skin.
///
/// # Example
/// ```
/// use argil_skin::{SkinOptions, zones};
/// use geo::Area;
/// use geo_types::{MultiPolygon, Rect};
/// let square = |side: f64| MultiPolygon(vec![Rect::new((0.0, 0.0), (side, side)).to_polygon()]);
/// // Three layers of 40 mm under three of 20 mm: a step, 20 mm wide.
/// let outlines = [40.0, 40.0, 40.0, 20.0, 20.0, 20.0].map(square);
/// let options = SkinOptions { skin: 1, ..SkinOptions::for_width(1.5) };
/// let closed = zones(&outlines.iter().collect::<Vec<_>>(), &options)?;
/// let area = |layer: usize| closed[layer].unsigned_area();
/// assert!((area(0) - 1600.0).abs() < 1.0 && (area(5) - 400.0).abs() < 1.0); // underside and roof
/// assert!(area(1) == 0.0 && area(4) == 0.0);
/// assert!((1200.0..1230.0).contains(&area(2))); // the step, and a little under what stands on it
/// # Ok::<(), argil_skin::FillError>(())
/// ```
pub fn zones(
    outlines: &[&MultiPolygon<f64>],
    options: &SkinOptions,
) -> Result<Vec<MultiPolygon<f64>>, FillError> {
    let width = options.width()?;
    let none = MultiPolygon(Vec::new());
    let whole = outlines;
    let plain: Vec<MultiPolygon<f64>> = whole.iter().map(|outline| plainer(outline, width)).collect();
    let outlines: Vec<&MultiPolygon<f64>> = plain.iter().collect();
    let mut zones = vec![none.clone(); outlines.len()];
    let top = outlines.len().saturating_sub(1);
    if options.skin > 0 {
        for (layer, outline) in outlines.iter().enumerate() {
            let above = outlines.get(layer + 1).copied().unwrap_or(&none);
            let below = layer.checked_sub(1).map_or(&none, |below| outlines[below]);
            let up = face(outline, above, width);
            let down = face(outline, below, width);
            for behind in 0..options.skin {
                for (face, other) in [(&up, layer.checked_sub(behind)), (&down, layer.checked_add(behind))] {
                    let Some(other) = other.filter(|&other| other <= top && !face.0.is_empty()) else {
                        continue;
                    };
                    let part = grown(face, UNDER * width, width).intersection(outlines[other]);
                    zones[other] = zones[other].union(&part);
                }
            }
        }
    }
    for (layer, (zone, outline)) in zones.iter_mut().zip(whole).enumerate() {
        if layer < options.floor {
            *zone = (*outline).clone();
        } else if !zone.0.is_empty() {
            *zone = zone.intersection(*outline);
        }
    }
    Ok(zones.into_iter().map(|zone| cleaned(zone, width)).collect())
}

/// What of an outline lies open where it is not covered by `cover`, if it is wider than a bead.
fn face(outline: &MultiPolygon<f64>, cover: &MultiPolygon<f64>, width: f64) -> MultiPolygon<f64> {
    if cover.0.is_empty() {
        return outline.clone();
    }
    opened(&outline.difference(cover), 0.5 * FACE * width, width)
}
