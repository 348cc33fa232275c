use roxmltree::Node;

use super::attribute::unreadable;
use crate::LayersError;

/// The namespace in which Slic3r says what a group or a shape is.
pub(super) const SLIC3R: &str = "http://slic3r.org/namespaces/slic3r";

/// Heights are written with four digits after the point: each may be wrong by half of the last, and their difference by all of it.
const ROUNDING: f64 = 1.5e-4;

/// The height of all layers in millimetres, where Slic3r's attributes state it: `slic3r:layer-height` of each, or else the
/// distance between their `slic3r:z`.
pub(super) fn layer_height(groups: &[Node<'_, '_>]) -> Result<Option<f64>, LayersError> {
    let stated = |name: &'static str| {
        let value = |group: &Node<'_, '_>| {
            let text = group.attribute((SLIC3R, name))?;
            let number = text.trim().parse().ok().filter(|value: &f64| value.is_finite());
            Some(number.ok_or_else(|| unreadable(*group, name, &format!("`{text}` is no length"))))
        };
        groups.iter().map(value).collect::<Option<Result<Vec<f64>, _>>>().transpose()
    };
    if let Some(heights) = stated("layer-height")? {
        return one_of(&heights, 0).map(Some);
    }
    let Some(tops) = stated("z")?.filter(|tops| tops.len() > 1) else { return Ok(None) };
    let steps: Vec<f64> = tops.windows(2).map(|pair| pair[1] - pair[0]).collect();
    one_of(&steps, 1).map(Some)
}

/// The mean of heights, of which none may differ from it by more than they are rounded; the first is that of layer `first`.
fn one_of(heights: &[f64], first: usize) -> Result<f64, LayersError> {
    let height = heights.iter().sum::<f64>() / heights.len().max(1) as f64;
    // So many digits are written, and no more are meant.
    let height = (height * 1e4).round() / 1e4;
    match heights.iter().position(|found| (found - height).abs() > ROUNDING) {
        Some(layer) => Err(LayersError::Heights { layer: layer + first, found: heights[layer], height }),
        None => Ok(height),
    }
}
