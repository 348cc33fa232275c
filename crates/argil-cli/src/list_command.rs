//! `argil printers` and `argil materials`.

use std::process::ExitCode;

use argil_printers::{Material, Printer, materials, printers};

use crate::failure::Failure;
use crate::output::print;
use crate::profiles;

/// Lists the printers, or shows one.
pub(crate) fn list_printers(name: Option<&str>) -> Result<ExitCode, Failure> {
    match name {
        Some(name) => show(&profiles::printer(name)?)?,
        None => {
            let mut list = String::new();
            for (name, text) in printers() {
                let printer = Printer::from_toml(text).map_err(|source| Failure::input(name, source))?;
                list += &format!("{name:<24} {}\n", printer.name);
            }
            print("list of printers", list.as_bytes())?;
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// Lists the materials, or shows one.
pub(crate) fn list_materials(name: Option<&str>) -> Result<ExitCode, Failure> {
    match name {
        Some(name) => show(&profiles::material(name)?)?,
        None => {
            let mut list = String::new();
            for (name, text) in materials() {
                let material = Material::from_toml(text).map_err(|source| Failure::input(name, source))?;
                list += &format!("{name:<24} {}\n", material.name);
            }
            print("list of materials", list.as_bytes())?;
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// The profile as the file that it is: what is shown can be saved, changed and given to `--printer`.
fn show(profile: &impl serde::Serialize) -> Result<(), Failure> {
    let text = toml::to_string_pretty(profile)
        .map_err(|source| Failure::Output { what: "profile", source: Box::new(source) })?;
    print("profile", text.as_bytes())
}
