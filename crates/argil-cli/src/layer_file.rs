//! Layers of polygons from another program, as SVG or JSON.

use argil::Settings;
use argil::mesh::{Mesh, Unit};
use argil::slice::stacked;
use argil_layers::{Layers, is_json, json};

use crate::args::PlaceArgs;
use crate::failure::Failure;
use crate::input::odd_size;

/// Chords of curves lie beside them by at most this share of a bead.
#[cfg(feature = "svg")]
const CHORD_ERROR: f64 = 1e-3;

/// Layers as a mesh that is cut into them.
pub(crate) struct LayerFile {
    pub(crate) mesh: Mesh,
    /// Height of each, mm.
    pub(crate) layer_height: f64,
    /// What is to be said about the file.
    pub(crate) remarks: Vec<String>,
}

/// Whether bytes are such a file.
pub(crate) fn is_layer_file(bytes: &[u8]) -> bool {
    #[cfg(feature = "svg")]
    if argil_layers::is_svg(bytes) {
        return true;
    }
    is_json(bytes)
}

/// Reads the layers, in the unit that is given here or in the file, or else in millimetres. Where the file does not say how high its
/// layers are, they are as high as the plan's once they have their size.
pub(crate) fn read(
    name: &str,
    bytes: &[u8],
    place: PlaceArgs,
    settings: &Settings,
) -> Result<LayerFile, Failure> {
    let unit = place.unit.map(Unit::from);
    let found = layers(bytes, unit, place, settings).map_err(|source| Failure::layers(name, source))?;
    let mut remarks = found.remarks.clone();
    if !found.has_unit && place.scale.is_none() && place.height.is_none() {
        remarks.extend(odd_size(found.extent()));
    }
    let layer_height = found.layer_height.unwrap_or_else(|| {
        remarks.push(format!(
            "it does not say how high its layers are: {} mm is taken, the height of the plan's",
            settings.layer_height
        ));
        settings.layer_height
            / (place.shrinkage.unwrap_or_default().factors()[2] * place.scale.unwrap_or(1.0))
    });
    let mesh = stacked(&found.layers, layer_height).map_err(|source| Failure::layers(name, source))?;
    Ok(LayerFile { mesh, layer_height, remarks })
}

#[cfg(feature = "svg")]
fn layers(
    bytes: &[u8],
    unit: Option<Unit>,
    place: PlaceArgs,
    settings: &Settings,
) -> Result<Layers, argil_layers::LayersError> {
    if !argil_layers::is_svg(bytes) {
        return json(bytes, unit);
    }
    let chord_error = CHORD_ERROR * settings.width / place.scale.unwrap_or(1.0);
    argil_layers::svg(bytes, &argil_layers::SvgSettings { unit, chord_error })
}

#[cfg(not(feature = "svg"))]
fn layers(
    bytes: &[u8],
    unit: Option<Unit>,
    _: PlaceArgs,
    _: &Settings,
) -> Result<Layers, argil_layers::LayersError> {
    json(bytes, unit)
}
