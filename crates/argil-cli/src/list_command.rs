//! `argil printers` and `argil materials`.

use std::process::ExitCode;

use argil_printers::{Material, Printer, materials, printers};

use crate::failure::Failure;
use crate::profiles;

/// Lists the printers, or shows one.
pub(crate) fn list_printers(name: Option<&str>) -> Result<ExitCode, Failure> {
    match name {
        Some(name) => show(&profiles::printer(name)?)?,
        None => {
            for (name, text) in printers() {
                let printer = Printer::from_toml(text).map_err(|source| Failure::input(name, source))?;
                println!("{name:<24} {}", printer.name);
            }
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// Lists the materials, or shows one.
pub(crate) fn list_materials(name: Option<&str>) -> Result<ExitCode, Failure> {
    match name {
        Some(name) => show(&profiles::material(name)?)?,
        None => {
            for (name, text) in materials() {
                let material = Material::from_toml(text).map_err(|source| Failure::input(name, source))?;
                println!("{name:<24} {}", material.name);
            }
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// The profile as the file that it is: what is shown can be saved, changed and given to `--printer`.
fn show(profile: &impl serde::Serialize) -> Result<(), Failure> {
    let text = toml::to_string_pretty(profile)
        .map_err(|source| Failure::Output { what: "profile", source: Box::new(source) })?;
    print!("{text}");
    Ok(())
}
