//! A wall of concrete with a bead of 30 mm: the same plan as in clay, fifteen times as large.

use std::error::Error;

use argil::gcode::{GcodeSettings, write_gcode};
use argil::mesh::Mesh;
use argil::{Material, Plan, Planner, Settings};
use argil_audit::{AuditSettings, Report, audit, gcode::read_gcode};

/// The bundled columns, `scale` times as large as they are.
fn columns(scale: f64) -> Result<Mesh, Box<dyn Error>> {
    let model = argil::mesh::read_stl(&argil_models::by_name("columns").ok_or("no such model")?.to_stl())?;
    let vertices = model.vertices().iter().map(|v| v.map(|x| scale * x)).collect();
    Ok(Mesh::new(vertices, model.triangles().to_vec())?)
}

fn planned(mesh: &Mesh, width: f64) -> Result<(Plan, Report), Box<dyn Error>> {
    // Less of the bead beside the one below, and shorter bridges: this concrete bears less than clay does.
    let material = Material { across: 0.25, along: 1.2 };
    let settings = Settings { material, ..Settings::for_width(width) };
    let plan = Planner::default().plan(mesh, &settings)?;
    let wanted = AuditSettings {
        across: settings.criterion().across,
        along: settings.criterion().along,
        ..AuditSettings::for_width(width)
    };
    // A pump that is driven by volume, and metres a minute.
    let machine = GcodeSettings {
        mm3_per_e: 1.0,
        feed: 150.0,
        first_layer_feed: 100.0,
        lift: 50.0,
        ..GcodeSettings::default()
    };
    let report = audit(&read_gcode(&write_gcode(&plan.strand, &machine)?), mesh, &wanted)?;
    Ok((plan, report))
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let (clay, _) = planned(&columns(1.0)?, 2.0)?;
    let (concrete, report) = planned(&columns(15.0)?, 30.0)?;
    assert!(report.is_sound(), "{report}");
    assert_eq!(concrete.strand.layers().len(), clay.strand.layers().len());
    let ratio = concrete.strand.length() / (15.0 * clay.strand.length());
    assert!((ratio - 1.0).abs() < 0.02, "{ratio} of the length that scaling gives");
    // A cubic metre holds a thousand million of the strand's cubic millimetres.
    assert!((0.001..1.0).contains(&(concrete.strand.volume() / 1e9)));
    Ok(())
}
