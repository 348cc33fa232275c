use argil_mesh::Unit;
use glam::DVec2;
use serde::Deserialize;

use crate::LayersError;
use crate::layers::Layers;

/// The file as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LayerFile {
    /// Name of the unit.
    unit: Option<String>,
    layer_height: f64,
    /// Bottom first; closed contours of x and y each.
    layers: Vec<Vec<Vec<[f64; 2]>>>,
}

/// Whether bytes may be such a file: JSON begins with a brace, and no format of meshes does.
#[must_use]
pub fn is_json(bytes: &[u8]) -> bool {
    bytes.trim_ascii_start().starts_with(b"{")
}

/// Layers in JSON: an object with `layer_height`, `layers` (lists of contours, lists of points `[x, y]`) and, if it is not
/// millimetres, `unit`. A unit that is given here comes before that of the file.
///
/// # Errors
/// [`LayersError::Json`] and [`LayersError::Unit`]. Whether coordinates are lengths that can be printed is for those to say who print.
///
/// # Complexity
/// Linear in the bytes.
///
/// # Example
/// ```
/// use argil_layers::json;
/// let file = br#"{ "unit": "cm", "layer_height": 0.1, "layers": [[[[0, 0], [2, 0], [2, 2], [0, 2]]]] }"#;
/// let layers = json(file, None)?;
/// assert_eq!((layers.extent(), layers.layer_height), (20.0, Some(1.0)));
/// # Ok::<(), argil_layers::LayersError>(())
/// ```
pub fn json(bytes: &[u8], unit: Option<Unit>) -> Result<Layers, LayersError> {
    let file: LayerFile =
        serde_json::from_slice(bytes).map_err(|error| LayersError::Json { why: error.to_string() })?;
    let stated = match file.unit {
        Some(name) => Some(Unit::named(&name).ok_or(LayersError::Unit { name })?),
        None => None,
    };
    let factor = unit.or(stated).map_or(1.0, Unit::millimetres);
    let contour = |points: Vec<[f64; 2]>| points.into_iter().map(|p| DVec2::from(p) * factor).collect();
    let layer = |contours: Vec<Vec<[f64; 2]>>| contours.into_iter().map(contour).collect();
    Ok(Layers {
        layers: file.layers.into_iter().map(layer).collect(),
        layer_height: Some(file.layer_height * factor),
        // The form has a unit of its own where none is named.
        has_unit: true,
        remarks: Vec::new(),
    })
}
