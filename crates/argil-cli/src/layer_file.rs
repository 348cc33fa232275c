//! Layers of polygons from another program, as JSON.

use argil::curve::DVec2;
use argil::mesh::{Mesh, Unit};
use argil::slice::stacked;
use clap::ValueEnum;
use serde::Deserialize;

use crate::args::UnitArg;
use crate::failure::Failure;

/// The file as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LayerFile {
    /// Name of the unit, as `--unit` has it.
    unit: Option<String>,
    layer_height: f64,
    /// Bottom first; closed contours of x and y each.
    layers: Vec<Vec<Vec<[f64; 2]>>>,
}

/// Layers as a mesh that is cut into them.
pub(crate) struct Layers {
    pub(crate) mesh: Mesh,
    /// Height of each, mm.
    pub(crate) layer_height: f64,
}

/// Whether bytes are such a file: JSON begins with a brace, and no format of meshes does.
pub(crate) fn is_layer_file(bytes: &[u8]) -> bool {
    bytes.trim_ascii_start().starts_with(b"{")
}

/// Reads the layers, in the unit that is given here or in the file, or else in millimetres.
pub(crate) fn read(name: &str, bytes: &[u8], unit: Option<UnitArg>) -> Result<Layers, Failure> {
    let file: LayerFile = serde_json::from_slice(bytes).map_err(|source| Failure::layers(name, source))?;
    let stated = match &file.unit {
        Some(stated) => {
            Some(UnitArg::from_str(stated, false).map_err(|why| Failure::layers(name, UnitError(why)))?)
        }
        None => None,
    };
    let factor = unit.or(stated).map_or(1.0, |unit| Unit::from(unit).millimetres());
    let contour = |points: Vec<[f64; 2]>| points.into_iter().map(|p| DVec2::from(p) * factor).collect();
    let layer = |contours: Vec<Vec<[f64; 2]>>| contours.into_iter().map(contour).collect();
    let layers: Vec<Vec<Vec<DVec2>>> = file.layers.into_iter().map(layer).collect();
    let layer_height = file.layer_height * factor;
    let mesh = stacked(&layers, layer_height).map_err(|source| Failure::layers(name, source))?;
    Ok(Layers { mesh, layer_height })
}

/// A unit that is none.
#[derive(Debug)]
struct UnitError(String);

impl std::fmt::Display for UnitError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "unit: {}", self.0)
    }
}

impl std::error::Error for UnitError {}
