//! Models and settings from the command line.

use std::path::Path;

use argil::mesh::{Ground, Mesh, Placement, Size, read_stl};
use argil::{Material, Settings};

use crate::args::{BeadArgs, Place, PlaceArgs};
use crate::failure::Failure;

/// What names a bundled model in place of a file.
const SAMPLE: &str = "sample:";

/// The placed mesh of a file or bundled model.
pub(crate) fn model(name: &str, place: PlaceArgs) -> Result<Mesh, Failure> {
    let bytes = match name.strip_prefix(SAMPLE) {
        Some(sample) => {
            argil_models::by_name(sample).ok_or_else(|| Failure::Sample { name: sample.to_owned() })?.to_stl()
        }
        None => std::fs::read(name).map_err(|source| Failure::reading(Path::new(name), source))?,
    };
    let mesh = read_stl(&bytes).map_err(|source| Failure::input(name, source))?;
    let size = match (place.scale, place.height) {
        (Some(factor), _) => Size::Scale(factor),
        (_, Some(height)) => Size::Height(height),
        _ => Size::Modelled,
    };
    let ground = match place.place {
        Place::Keep => Ground::Keep,
        Place::Center => Ground::Centre,
    };
    mesh.placed(&Placement { size, ground }).map_err(|source| Failure::input(name, source))
}

/// The settings of a plan.
pub(crate) fn settings(bead: &BeadArgs) -> Result<Settings, Failure> {
    let mut settings = Settings::for_width(bead.width);
    settings.walls = bead.walls;
    settings.material = Material { across: bead.across, along: bead.along };
    if let Some(height) = bead.layer_height {
        settings.layer_height = height;
    }
    settings.check().map_err(Failure::option)?;
    Ok(settings)
}
