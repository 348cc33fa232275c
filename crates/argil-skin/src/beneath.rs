//! Where sparse fill has to stand so that it holds what is filled above it.

use std::collections::BTreeMap;

use argil_fill::FillError;
use geo::BooleanOps;
use geo_types::MultiPolygon;

use crate::SkinOptions;
use crate::offset::{cleaned, grown};
use crate::section::Section;

/// Layers that a fill of the deepest part may reach down; what is deeper than so many retreats is held all the way down.
const MOST_LAYERS: usize = 100_000;

/// What of each layer's hollow lies below a [zone](crate::zones) that is filled and has to be filled sparsely to hold it, bottom first.
///
/// Below the lowest layer of a roof it is all that the roof covers. Farther down it draws back from the middle towards the walls,
/// by `retreat` mm a layer, so that ends of lanes stand on the lanes below; it ends on what is solid, or where it has
/// drawn back to the walls.
///
/// # Errors
/// [`FillError::Option`] for a width or a retreat that is none.
///
/// # Complexity
/// A few polygon operations for each layer and each depth, in retreats, that parts below roofs have there.
///
/// # Example
/// ```
/// use argil_skin::{Section, SkinOptions, beneath, zones};
/// use geo::Area;
/// use geo_types::{MultiPolygon, Rect};
/// let square = MultiPolygon(vec![Rect::new((0.0, 0.0), (20.0, 20.0)).to_polygon()]);
/// let options = SkinOptions { skin: 1, ..SkinOptions::for_width(1.5) };
/// let closed = zones(&[&square; 12], &options)?;
/// let sections = [Section { outline: &square, walls: &[] }; 12];
/// let hollow = beneath(&sections, &closed, 1.5, &options)?;
/// let areas: Vec<f64> = hollow.iter().map(|part| part.unsigned_area()).collect();
/// assert!(areas[11] == 0.0 && areas[10] > 280.0); // the roof itself, and all below it
/// assert!(areas.windows(2).take(10).all(|pair| pair[0] <= pair[1])); // less and less farther down
/// assert!(areas[3] == 0.0);
/// # Ok::<(), argil_skin::FillError>(())
/// ```
pub fn beneath(
    sections: &[Section<'_>],
    zones: &[MultiPolygon<f64>],
    retreat: f64,
    options: &SkinOptions,
) -> Result<Vec<MultiPolygon<f64>>, FillError> {
    let width = options.width()?;
    if !(retreat > 0.0 && retreat.is_finite()) {
        return Err(FillError::Option { name: "retreat", value: retreat, expected: "positive and finite" });
    }
    let none = MultiPolygon(Vec::new());
    let mut found = vec![none.clone(); sections.len()];
    // By how many layers they still reach down.
    let mut hanging: BTreeMap<usize, MultiPolygon<f64>> = BTreeMap::new();
    let mut above = none;
    for (k, section) in sections.iter().enumerate().rev() {
        let solid = match zones.get(k) {
            Some(zone) => section.room(zone, options, width),
            None => MultiPolygon(Vec::new()),
        };
        if above.0.is_empty() && hanging.is_empty() {
            above = solid;
            continue;
        }
        let inside = section.inside(options, width);
        let hollow = if solid.0.is_empty() { inside.clone() } else { inside.difference(&solid) };
        let mut now: BTreeMap<usize, MultiPolygon<f64>> = BTreeMap::new();
        let mut add = |depth: usize, part: MultiPolygon<f64>| {
            if depth == 0 || part.0.is_empty() {
                return;
            }
            let known = now.remove(&depth);
            now.insert(depth, known.map_or_else(|| part.clone(), |known| known.union(&part)));
        };
        for (depth, part) in &hanging {
            let left = part.intersection(&hollow);
            let middle = grown(&inside, -(*depth as f64) * retreat, width);
            let left = if middle.0.is_empty() { left } else { left.difference(&middle) };
            add(*depth, cleaned(left, width));
        }
        let first = cleaned(above.intersection(&hollow), width);
        for polygon in first {
            let part = MultiPolygon(vec![polygon]);
            add(depth_of(&part, &inside, retreat, width), part);
        }
        let all = now.values().cloned().reduce(|all, part| all.union(&part));
        found[k] = all.unwrap_or_else(|| MultiPolygon(Vec::new()));
        hanging =
            now.into_iter().filter(|(depth, _)| *depth > 1).map(|(depth, part)| (depth - 1, part)).collect();
        above = solid;
    }
    Ok(found)
}

/// How many retreats deep a part reaches into its inside, rounded up.
fn depth_of(part: &MultiPolygon<f64>, inside: &MultiPolygon<f64>, retreat: f64, width: f64) -> usize {
    let reaches = |depth: usize| {
        let middle = grown(inside, -(depth as f64) * retreat, width);
        !cleaned(middle.intersection(part), width).0.is_empty()
    };
    let mut most = 1;
    while most < MOST_LAYERS && reaches(most) {
        most *= 2;
    }
    let mut least = most / 2;
    while most - least > 1 {
        let middle = least.midpoint(most);
        if reaches(middle) {
            least = middle;
        } else {
            most = middle;
        }
    }
    most
}
