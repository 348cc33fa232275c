//! A plan and what the audit says of its g-code.

use argil::gcode::{GcodeSettings, read_gcode, write_gcode};
use argil::mesh::Mesh;
use argil::{Plan, PlanError, Planner, Settings};
use argil_audit::{AuditSettings, Report, audit};

use crate::{Model, Outcome};

/// Heads of the columns that [`Measured::row`] fills.
pub(crate) const COLUMNS: [&str; 16] = [
    "model",
    "walls",
    "sound",
    "ratio",
    "doubled",
    "over",
    "contact",
    "outside",
    "excursions per m",
    "step, mm",
    "turns",
    "bends",
    "coherence, w",
    "jumps, %",
    "bare, %",
    "plan, s",
];

/// A model with so many walls: its plan and report, or why there is none.
pub(crate) struct Measured {
    name: String,
    walls: usize,
    pub(crate) plan: Option<Plan>,
    pub(crate) gcode: Option<String>,
    pub(crate) report: Option<Report>,
    failure: String,
}

/// The settings of all results: clay, one and a half millimetres wide.
pub(crate) fn settings(walls: usize) -> Settings {
    Settings { walls, ..Settings::for_width(1.5) }
}

/// Plans and audits a model.
pub(crate) fn measured(model: &Model, walls: usize) -> Outcome<Measured> {
    let mut measured = Measured {
        name: model.name.clone(),
        walls,
        plan: None,
        gcode: None,
        report: None,
        failure: String::new(),
    };
    let plan = Planner::default().plan(&model.mesh, &settings(walls));
    match told(plan, &model.mesh, walls)? {
        Ok((plan, gcode, report)) => {
            measured.plan = Some(plan);
            measured.gcode = Some(gcode);
            measured.report = Some(report);
        }
        Err(failure) => measured.failure = failure,
    }
    Ok(measured)
}

/// What there is when planning went well: the plan, its g-code and report; else why there is none.
pub(crate) type Planned = Result<(Plan, String, Report), String>;

/// The g-code and the report of a plan.
pub(crate) fn told(plan: Result<Plan, PlanError>, mesh: &Mesh, walls: usize) -> Outcome<Planned> {
    match plan {
        Ok(plan) => {
            let gcode = write_gcode(&plan.strand, &GcodeSettings::default())?;
            let report = audited(&gcode, mesh, walls)?;
            Ok(Ok((plan, gcode, report)))
        }
        Err(error) => Ok(Err(error.to_string())),
    }
}

/// The audit of a g-code text.
pub(crate) fn audited(gcode: &str, mesh: &Mesh, walls: usize) -> Outcome<Report> {
    let settings = settings(walls);
    let criterion = settings.criterion();
    let wanted = AuditSettings {
        layer_height: settings.layer_height,
        walls,
        across: criterion.across,
        along: criterion.along,
        ..AuditSettings::for_width(settings.width)
    };
    Ok(audit(&read_gcode(gcode), mesh, &wanted)?)
}

impl Measured {
    /// The row of a table with [`COLUMNS`].
    pub(crate) fn row(&self) -> Vec<String> {
        let mut row = vec![self.name.clone(), self.walls.to_string()];
        let (Some(plan), Some(report)) = (&self.plan, &self.report) else {
            row.push(format!("no plan: {}", self.failure));
            return row;
        };
        let f = &report.figures;
        row.extend([
            verdict(report),
            format!("{:.3}", f.material_ratio),
            format!("{:.3}", f.doubled_per_model_mm),
            format!("{:.4}", f.overdeposit_apart_from_roots),
            format!("{:.3}", f.contact_per_model_mm),
            format!("{:.4}", f.contact_outside_apart_from_roots),
            format!("{:.0}", 0.5 * f.roots_per_model_m),
            format!("{:.2}", f.seam_gap_max_mm),
            f.sharp_turns_nonmodel.to_string(),
            f.sharp_bends_nonmodel.to_string(),
            format!("{:.2}", f.coherence_widths),
            format!("{:.2}", 100.0 * f.jumps_fraction),
            format!("{:.2}", 100.0 * f.contour_uncovered_fraction),
            format!("{:.1}", plan.times.total().as_secs_f64()),
        ]);
        row
    }
}

/// "yes", or what falls short.
pub(crate) fn verdict(report: &Report) -> String {
    let short: Vec<String> = report
        .falls_short()
        .iter()
        .map(|s| format!("{} {}", s.figure.replace('_', " "), (1e3 * s.value).round() / 1e3))
        .collect();
    if short.is_empty() { "yes".to_owned() } else { format!("no: {}", short.join(", ")) }
}
