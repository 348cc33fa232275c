//! The verdict on a finished plan: its g-code, read back and measured against the mesh by geometry alone.

use argil::gcode::{GcodeSettings, read_gcode, write_gcode};
use argil::mesh::Mesh;
use argil::{Plan, Settings};
use argil_audit::{AuditSettings, Report, audit};

/// The g-code of a plan.
pub(crate) fn gcode(plan: &Plan) -> String {
    write_gcode(&plan.strand, &GcodeSettings::default()).expect("a strand can be written")
}

/// What the audit says of the plan's g-code.
pub(crate) fn audited(plan: &Plan, mesh: &Mesh, settings: &Settings) -> Report {
    let criterion = settings.criterion();
    let wanted = AuditSettings {
        layer_height: settings.layer_height,
        walls: settings.walls,
        floor: settings.floor,
        skin: settings.skin > 0,
        surface: settings.surface,
        across: criterion.across,
        along: criterion.along,
        ..AuditSettings::for_width(settings.width)
    };
    audit(&read_gcode(&gcode(plan)), mesh, &wanted).expect("the audit can measure the file")
}
