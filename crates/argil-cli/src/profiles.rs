//! Printer and material of a plan, by name or from a file.

use std::fs;
use std::path::Path;

use argil::Bed;
use argil_printers::{Material, Printer, ProfileError, Volume, materials, printers};

use crate::args::BeadArgs;
use crate::failure::Failure;

/// What a plan is made for.
#[derive(Debug, Default)]
pub(crate) struct Profiles {
    pub(crate) printer: Option<Printer>,
    pub(crate) material: Option<Material>,
}

impl Profiles {
    /// The profiles that the options name.
    pub(crate) fn of(bead: &BeadArgs) -> Result<Self, Failure> {
        Ok(Self {
            printer: bead.printer.as_deref().map(printer).transpose()?,
            material: bead.material.as_deref().map(material).transpose()?,
        })
    }

    /// Width and height of the bead where options leave them open: the printer's, then the material's. They belong
    /// together, so half of a pair is not taken.
    pub(crate) fn bead(&self) -> Option<(f64, Option<f64>)> {
        let of_printer = self.printer.as_ref().map(|p| (p.width.value(), p.layer_height.value()));
        let of_material = self.material.as_ref().map(|m| (m.width.value(), m.layer_height.value()));
        let pairs = [of_printer, of_material].into_iter().flatten();
        pairs.filter_map(|(width, height)| Some((*width?, height.copied()))).next()
    }

    /// The printer's bed, if it is known.
    pub(crate) fn bed(&self) -> Option<Bed> {
        let printer = self.printer.as_ref()?;
        let ([mx, my], volume) = (printer.middle()?, printer.volume.value()?);
        Some(match *volume {
            Volume::Box { x, y, .. } => {
                Bed::Rectangle { low: [mx - x / 2.0, my - y / 2.0], high: [mx + x / 2.0, my + y / 2.0] }
            }
            Volume::Round { diameter, .. } => Bed::Disc { middle: [mx, my], radius: diameter / 2.0 },
        })
    }
}

/// A bundled printer, or one from a file.
pub(crate) fn printer(name: &str) -> Result<Printer, Failure> {
    match Printer::bundled(name) {
        Some(found) => found.map_err(|source| Failure::input(name, source)),
        None => from_file(name, "printer", "argil printers", &names(printers()), Printer::from_toml),
    }
}

/// A bundled material, or one from a file.
pub(crate) fn material(name: &str) -> Result<Material, Failure> {
    match Material::bundled(name) {
        Some(found) => found.map_err(|source| Failure::input(name, source)),
        None => from_file(name, "material", "argil materials", &names(materials()), Material::from_toml),
    }
}

fn names(listed: &[(&'static str, &'static str)]) -> Vec<&'static str> {
    listed.iter().map(|(name, _)| *name).collect()
}

fn from_file<P>(
    name: &str,
    what: &'static str,
    list: &'static str,
    known: &[&'static str],
    read: impl Fn(&str) -> Result<P, ProfileError>,
) -> Result<P, Failure> {
    let path = Path::new(name);
    // What looks like a file is one; anything else is a slip in a name.
    if !path.exists() && path.extension().is_none() && path.components().count() == 1 {
        let near = known.iter().find(|other| other.contains(name) || name.contains(*other)).copied();
        return Err(Failure::Profile { what, name: name.to_owned(), list, near });
    }
    let text = fs::read_to_string(path).map_err(|source| Failure::reading(path, source))?;
    read(&text).map_err(|source| Failure::input(name, source))
}
