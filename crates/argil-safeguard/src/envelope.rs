use crate::SafeguardSettings;
use argil_curve::{DVec2, self_crossings, without_needles};
use geo::bool_ops::FillRule;
use geo::buffer::{BufferStyle, LineJoin};
use geo::{BooleanOps, Buffer, CoordsIter, Simplify};
use geo_types::{Coord, LineString, MultiPolygon, Polygon};
#[cfg(feature = "rayon")]
use rayon::prelude::*;

/// Coordinates beyond this, in millimetres, are no place on a printer, and the polygon kernel
/// cannot put them on its grid.
const FARTHEST: f64 = 1e9;

/// Layers between two questions whether to go on.
const BATCH: usize = 16;

/// The safeguard of each layer, bottom first (Sec. 3.4).
///
/// `outer_walls` holds the filled outermost wall loops of each layer, bottom first; holes in
/// them count as holes. With d the dilation and ε the shrinking,
///
/// ```text
/// S_0 = dilate(walls_0, d),   S_i = erode(S_{i−1}, ε) ∪ dilate(walls_i, d)
/// ```
///
/// Each result contains the exact region of this formula (applied to the result below it) and is larger by at
/// most a fifth of ε: the curves are grown by a tenth of it and then simplified by no more. So two
/// things hold without a tolerance: `S_i` contains everything within d of its walls, and each
/// point outside `S_i` is within ε of a point outside `S_{i−1}`.
///
/// Settings that are negative or not finite count as zero; polygons with coordinates that are not
/// finite (or beyond 1e9 mm) are left out, and so are needles without any width.
///
/// # Complexity
/// Near linear in the vertices of a layer's walls and of the safeguard below. The number of vertices of a
/// result is bounded by the length of its boundary over a fixed fraction of w, whatever the number of layers.
///
/// # Example
/// ```
/// use argil_safeguard::{safeguards, SafeguardSettings};
/// use geo_types::{polygon, MultiPolygon};
/// let wall = polygon![(x: 0.0, y: 0.0), (x: 3.0, y: 0.0), (x: 0.0, y: 3.0)];
/// let layers = [MultiPolygon(vec![wall]), MultiPolygon(vec![]), MultiPolygon(vec![])];
/// // A model that ends leaves an envelope that closes in by ε a layer until nothing is left.
/// let envelope = safeguards(&layers, &SafeguardSettings { dilation: 0.1, shrink: 0.7 });
/// assert_eq!(envelope.iter().map(|s| s.0.len()).collect::<Vec<_>>(), [1, 1, 0]);
/// ```
#[must_use]
pub fn safeguards(outer_walls: &[MultiPolygon<f64>], settings: &SafeguardSettings) -> Vec<MultiPolygon<f64>> {
    // Nobody ends it, so that there are safeguards.
    safeguards_while(outer_walls, settings, &mut || true).unwrap_or_default()
}

/// The same for as long as `goes_on` says so: it is asked before every sixteen layers. `None` where it has ended the work.
///
/// # Complexity
/// That of [`safeguards`].
///
/// # Example
/// ```
/// use argil_safeguard::{safeguards_while, SafeguardSettings};
/// # use geo_types::MultiPolygon;
/// let layers = vec![MultiPolygon(vec![]); 40];
/// assert_eq!(safeguards_while(&layers, &SafeguardSettings::for_width(1.5), &mut || false), None);
/// ```
#[must_use]
pub fn safeguards_while(
    outer_walls: &[MultiPolygon<f64>],
    settings: &SafeguardSettings,
    goes_on: &mut dyn FnMut() -> bool,
) -> Option<Vec<MultiPolygon<f64>>> {
    let length = |value: f64| if value.is_finite() { value.clamp(0.0, FARTHEST) } else { 0.0 };
    let settings = SafeguardSettings { dilation: length(settings.dilation), shrink: length(settings.shrink) };
    let tolerance = settings.tolerance();
    let mut below = MultiPolygon(Vec::new());
    let mut result = Vec::with_capacity(outer_walls.len());
    for batch in outer_walls.chunks(BATCH) {
        if !goes_on() {
            return None;
        }
        for own in all_dilated(batch, settings.dilation, tolerance) {
            let shrunk = simplified(&offset(&below, tolerance - settings.shrink, 0.5 * tolerance), tolerance);
            below = united(&shrunk, &own);
            result.push(below.clone());
        }
    }
    Some(result)
}

/// The dilated walls of every layer. None depends on another layer, as the envelope itself does.
fn all_dilated(layers: &[MultiPolygon<f64>], distance: f64, tolerance: f64) -> Vec<MultiPolygon<f64>> {
    #[cfg(feature = "rayon")]
    let layers = layers.par_iter();
    #[cfg(not(feature = "rayon"))]
    let layers = layers.iter();
    layers.map(|walls| dilated(&usable(walls), distance, tolerance)).collect()
}

/// All points within `distance` of the walls, and at most twice the tolerance more.
///
/// Three things make it smaller than it should be: the simplification of the walls, the chords of
/// the round joins, and the simplification of the result. They share what it is grown by on top.
fn dilated(walls: &MultiPolygon<f64>, distance: f64, tolerance: f64) -> MultiPolygon<f64> {
    // The kernel may lose a ring that crosses itself, or bite into what lies round it, as it may be once it is simplified.
    let plain = |polygon: &Polygon<f64>| {
        let simple = polygon.simplify(0.4 * tolerance);
        let crosses = |ring: &LineString<f64>| !self_crossings(&corners(ring)).is_empty();
        let is_usable = !std::iter::once(simple.exterior()).chain(simple.interiors()).any(crosses);
        if is_usable { simple } else { polygon.clone() }
    };
    let walls = if tolerance > 0.0 { walls.iter().map(plain).collect() } else { walls.clone() };
    simplified(&offset(&walls, distance + tolerance, 0.2 * tolerance), 0.4 * tolerance)
}

/// Grows a region (or shrinks it, by a negative distance) with round joins whose chords cut off at most `chord_error`.
fn offset(region: &MultiPolygon<f64>, distance: f64, chord_error: f64) -> MultiPolygon<f64> {
    if region.0.is_empty() || distance == 0.0 {
        return region.clone();
    }
    // The kernel divides a turn by the angle and rounds the count down: a chord spans less than twice it.
    let angle = (1.0 - (chord_error / distance.abs()).min(0.3)).acos();
    region.buffer_with_style(BufferStyle::new(distance).line_join(LineJoin::Round(angle)))
}

/// The region with fewer vertices (Douglas and Peucker), no point of the boundary moved farther than the tolerance.
fn simplified(region: &MultiPolygon<f64>, tolerance: f64) -> MultiPolygon<f64> {
    if tolerance > 0.0 { region.simplify(tolerance) } else { region.clone() }
}

/// By the non-zero rule, since a simplified ring may run over itself where the region is thinner than the tolerance.
fn united(a: &MultiPolygon<f64>, b: &MultiPolygon<f64>) -> MultiPolygon<f64> {
    a.union_with_fill_rule(b, FillRule::NonZero)
}

/// The vertices of a ring without the repeated first.
fn corners(ring: &LineString<f64>) -> Vec<DVec2> {
    ring.0.iter().take(ring.0.len().saturating_sub(1)).map(|c| DVec2::new(c.x, c.y)).collect()
}

fn usable(region: &MultiPolygon<f64>) -> MultiPolygon<f64> {
    let is_place = |polygon: &&Polygon<f64>| {
        polygon.coords_iter().all(|c| c.x.abs() <= FARTHEST && c.y.abs() <= FARTHEST)
    };
    // At a needle without width the kernel bites into what lies round it.
    let without = |ring: &LineString<f64>| -> Option<LineString<f64>> {
        let kept = without_needles(&corners(ring));
        (kept.len() >= 3).then(|| kept.into_iter().map(|p| Coord { x: p.x, y: p.y }).collect())
    };
    let whole = |polygon: &Polygon<f64>| {
        let exterior = without(polygon.exterior())?;
        Some(Polygon::new(exterior, polygon.interiors().iter().filter_map(without).collect()))
    };
    MultiPolygon(region.iter().filter(is_place).filter_map(whole).collect())
}
