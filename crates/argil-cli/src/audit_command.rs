//! `argil audit`.

use std::process::ExitCode;

use argil::gcode::read_gcode;
use argil::mesh::Mesh;
use argil::{Document, Settings};
use argil_audit::{AuditSettings, Report, audit};

use crate::args::AuditArgs;
use crate::failure::{FINDINGS, Failure};
use crate::profiles::Profiles;
use crate::progress::Waiting;
use crate::stated::completed;
use crate::{input, output};

/// Measures a file and tells what it found.
pub(crate) fn run(args: &AuditArgs) -> Result<ExitCode, Failure> {
    let bytes = std::fs::read(&args.gcode).map_err(|source| Failure::reading(&args.gcode, source))?;
    let text = String::from_utf8_lossy(&bytes);
    let bead = completed(&args.bead, &text);
    let profiles = Profiles::of(&bead)?;
    let settings =
        Settings { floor: args.floor, skin: usize::from(args.skin), ..input::settings(&bead, &profiles)? };
    args.json.iter().try_for_each(|path| output::check(path))?;
    let mesh = input::model(&args.model, args.place, &profiles, &settings)?.mesh;
    let wanted = wanted(&settings);
    let wanted =
        AuditSettings { tolerance_width: args.tolerance_width.unwrap_or(wanted.tolerance_width), ..wanted };
    let waiting = Waiting::new("auditing", false);
    let report = audit(&read_gcode(&text), &mesh, &wanted)
        .map_err(|source| Failure::input(&args.gcode.display().to_string(), source))?;
    drop(waiting);
    if !args.json.as_deref().is_some_and(output::is_standard) {
        output::print("report", format!("{report}\n").as_bytes())?;
    }
    if let Some(path) = &args.json {
        let json = serde_json::to_vec_pretty(&Document(&report))
            .map_err(|source| Failure::Output { what: "report", source: Box::new(source) })?;
        output::write(path, &json)?;
    }
    Ok(if report.is_sound() { ExitCode::SUCCESS } else { ExitCode::from(FINDINGS) })
}

/// The audit of a g-code text against a placed mesh.
pub(crate) fn measure(
    text: &str,
    mesh: &Mesh,
    settings: &Settings,
) -> Result<Report, argil_audit::AuditError> {
    audit(&read_gcode(text), mesh, &wanted(settings))
}

/// What the audit has to know of a plan's settings.
fn wanted(settings: &Settings) -> AuditSettings {
    let criterion = settings.criterion();
    AuditSettings {
        layer_height: settings.layer_height,
        walls: settings.walls,
        floor: settings.floor,
        skin: settings.skin > 0,
        surface: settings.surface,
        across: criterion.across,
        along: criterion.along,
        ..AuditSettings::for_width(settings.width)
    }
}
