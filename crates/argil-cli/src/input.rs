//! Models and settings from the command line.

use std::path::Path;

use argil::mesh::{Format, Ground, Mesh, Placement, Repairs, Size, Soup, Unit};
use argil::{Material, Settings};

use crate::args::{BeadArgs, Place, PlaceArgs};
use crate::failure::Failure;
use crate::profiles::Profiles;
use crate::{layer_file, limits};

/// What names a bundled model in place of a file.
const SAMPLE: &str = "sample:";

/// Layer heights that differ by less than this share are the same, up to rounding: over 10,000 layers it is a tenth of one.
const SAME_HEIGHT: f64 = 1e-5;

/// A model as it is planned.
pub(crate) struct Model {
    /// Where it is to stand, in its size.
    pub(crate) mesh: Mesh,
    /// What was repaired, in the coordinates of the file.
    pub(crate) repairs: Repairs,
    /// What else there is to say about the file.
    pub(crate) remarks: Vec<String>,
}

/// The placed mesh of a file or bundled model, which is to be planned with these settings.
pub(crate) fn model(
    name: &str,
    place: PlaceArgs,
    profiles: &Profiles,
    settings: &Settings,
) -> Result<Model, Failure> {
    let layer_height = settings.layer_height;
    let bytes = match name.strip_prefix(SAMPLE) {
        Some(sample) => {
            argil_models::by_name(sample).ok_or_else(|| Failure::Sample { name: sample.to_owned() })?.to_stl()
        }
        None => {
            limits::check_file(Path::new(name))?;
            std::fs::read(name).map_err(|source| Failure::reading(Path::new(name), source))?
        }
    };
    if layer_file::is_layer_file(&bytes) {
        let layers = layer_file::read(name, &bytes, place, settings)?;
        let mesh = placed(name, &layers.mesh, place, profiles)?;
        let given = layers.layer_height * (mesh.bounds().size()[2] / layers.mesh.bounds().size()[2]);
        if (given / layer_height - 1.0).abs() > SAME_HEIGHT {
            return Err(Failure::LayerHeight { name: name.to_owned(), given, planned: layer_height });
        }
        limits::check_mesh(Path::new(name), &mesh, layer_height, place.memory)?;
        return Ok(Model { mesh, repairs: Repairs::default(), remarks: layers.remarks });
    }
    let (soup, remarks) = soup(name, bytes, place)?;
    let (mesh, repairs) = soup.repaired().map_err(|source| Failure::input(name, source))?;
    let mesh = placed(name, &mesh, place, profiles)?;
    limits::check_mesh(Path::new(name), &mesh, layer_height, place.memory)?;
    Ok(Model { mesh, repairs, remarks })
}

/// The triangles of a model file in millimetres, and what is to be said about it.
fn soup(name: &str, bytes: Vec<u8>, place: PlaceArgs) -> Result<(Soup, Vec<String>), Failure> {
    let extension = Path::new(name).extension().and_then(|extension| extension.to_str());
    let format = Format::of(&bytes, extension).ok_or_else(|| Failure::Format { name: name.to_owned() })?;
    let soup = format.read(&bytes).map_err(|source| Failure::reading_as(name, format, source))?;
    drop(bytes);
    let mut remarks: Vec<String> = soup.remarks.iter().map(ToString::to_string).collect();
    let unit = place.unit.map(Unit::from).or(soup.unit);
    if unit.is_none() && place.scale.is_none() && place.height.is_none() {
        let extent = soup.bounds().size().into_iter().fold(f64::NEG_INFINITY, f64::max);
        remarks.extend(odd_size(extent));
    }
    Ok((soup.in_millimetres(unit.unwrap_or(Unit::Millimetre)), remarks))
}

/// The mesh in its size and place.
fn placed(name: &str, mesh: &Mesh, place: PlaceArgs, profiles: &Profiles) -> Result<Mesh, Failure> {
    let factors = place.shrinkage.unwrap_or_default().factors();
    let mesh = mesh.stretched(factors).map_err(|source| Failure::input(name, source))?;
    let size = match (place.scale, place.height) {
        (Some(factor), _) => Size::Scale(factor),
        // The height is that of the fired piece.
        (_, Some(height)) => Size::Height(height * factors[2]),
        _ => Size::Modelled,
    };
    let bed = profiles.printer.as_ref().and_then(|printer| printer.middle()).map(Ground::At);
    let ground = match place.place {
        Some(Place::Keep) => Ground::Keep,
        Some(Place::Center) => Ground::Centre,
        Some(Place::Bed) => bed.ok_or(Failure::NoBed)?,
        None => bed.unwrap_or(Ground::Keep),
    };
    mesh.placed(&Placement { size, ground }).map_err(|source| Failure::input(name, source))
}

/// What is odd about the largest extent of a model whose file states no unit; nothing is guessed.
pub(crate) fn odd_size(extent: f64) -> Option<String> {
    let hint = Unit::hint(extent)?;
    Some(format!(
        "its largest extent is {extent} mm; if that is odd, say in which unit it was made, as by --unit {hint}"
    ))
}

/// The settings of a plan: options first, then printer and material, then defaults.
pub(crate) fn settings(bead: &BeadArgs, profiles: &Profiles) -> Result<Settings, Failure> {
    let known = profiles.bead().filter(|_| bead.width.is_none());
    let (width, height) = known.map_or((bead.width, None), |(width, height)| (Some(width), height));
    let mut settings = width.map_or_else(Settings::default, Settings::for_width);
    settings.walls = bead.walls.unwrap_or(settings.walls);
    settings.surface = bead.surface;
    if let Some(height) = bead.layer_height.or(height) {
        settings.layer_height = height;
    }
    let paste = profiles.material.as_ref();
    let across = paste.and_then(|paste| paste.across(settings.width, settings.layer_height));
    let along = paste.and_then(|paste| paste.bridge.value().copied());
    let Material { across: usual_across, along: usual_along } = settings.material;
    settings.material = Material {
        across: bead.across.or(across).unwrap_or(usual_across),
        along: bead.along.or(along).unwrap_or(usual_along),
    };
    settings.check().map_err(Failure::option)?;
    Ok(settings)
}
