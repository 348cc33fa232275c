//! `argil plan`.

use std::borrow::Cow;
use std::panic::resume_unwind;
use std::process::ExitCode;
use std::thread;

use argil::gcode::{Extrusion, GcodeError, GcodeSettings, Poses, write_gcode};
use argil::mesh::{Mesh, Repairs, Soup};
use argil::{Document, Plan, PlanError, Planner, Settings, Skirt, literal};
use argil_audit::Report;
use argil_preview::{SvgStyle, ViewStyle, layer_svg, overview_svg, png};

use crate::args::{Pattern, PlanArgs};
use crate::audit_command::measure;
use crate::cleaning_page::cleaning_page;
use crate::closed_slices::ClosedSlices;
use crate::failure::{FINDINGS, Failure};
use crate::input::Model;
use crate::machine::Beyond;
use crate::output::tell;
use crate::preview_page::preview_page;
use crate::profiles::Profiles;
use crate::progress::{PlanBar, Waiting};
use crate::report::{PlanReport, cleaning, missing, skirt_remark, summary};
use crate::{input, machine, output};

/// Longest side of the overview picture, pixels.
const PICTURE: u32 = 1600;

/// Plans a model and writes everything that was asked for.
pub(crate) fn run(args: &PlanArgs) -> Result<ExitCode, Failure> {
    let profiles = Profiles::of(&args.bead)?;
    let skirt = args.skirt.map(|turns| Skirt { turns, distance: args.skirt_distance, bed: profiles.bed() });
    let settings = Settings {
        wall_order: args.wall_order.into(),
        floor: args.floor,
        skin: args.skin,
        spiral: args.spiral,
        skirt,
        spirals: args.fill_pattern == Pattern::Spirals,
        infill: args.infill.unwrap_or_default(),
        even_flow: args.even_flow,
        ..input::settings(&args.bead, &profiles)?
    };
    settings.check().map_err(Failure::option)?;
    let mut written = machine::gcode_settings(&args.job(), &settings, &profiles)?;
    let files =
        [&args.repaired, &args.report, &args.strand, &args.png, &args.preview, &args.cleaning, &args.poses]
            .map(Option::as_ref);
    files.into_iter().chain([Some(&args.output)]).flatten().try_for_each(|path| output::check(path))?;
    let Model { mesh, repairs, remarks } = input::model(&args.model, args.place, &profiles, &settings)?;
    if args.strict {
        refuse_defects(&args.model, &repairs)?;
    }
    fits(args, "model", machine::model_beyond(&profiles, &mesh))?;
    remarks.iter().for_each(|remark| tell(format_args!("note: {}: {remark}", args.model)));
    repairs.to_string().lines().for_each(|line| tell(format_args!("repair: {}: {line}", args.model)));
    let (plan, repaired) = plan(&mesh, &settings, args)?;
    let plan = plan.map_err(|source| Failure::Plan { name: args.model.clone(), source })?;

    fits(args, "print", machine::strand_beyond(&profiles, &plan.strand))?;
    machine::complete(&mut written, &args.job(), &plan.strand)?;
    let gcode = gcode(&plan, &written)?;
    let audit = audited_and_drawn(args, &plan, &audited(&plan, &written, &gcode)?, &mesh, &settings)?;
    let poses = || Poses::new(&plan.strand, &written).map(|poses| poses.to_string()).map_err(unwritten);
    if machine::is_robot(&profiles) {
        output::write(&args.output, poses()?.as_bytes())?;
    } else {
        output::write(&args.output, gcode.as_bytes())?;
    }
    if let Some((path, repaired)) = args.repaired.as_ref().zip(repaired) {
        output::write(path, &repaired.to_stl())?;
    }
    if let Some(path) = &args.poses {
        output::write(path, poses()?.as_bytes())?;
    }
    if let Some(path) = &args.preview {
        let page = preview_page(&args.model, &settings, &written, &plan, audit.as_ref());
        output::write(path, page.as_bytes())?;
    }
    if let Some((path, audit)) = args.cleaning.as_ref().zip(audit.as_ref()) {
        output::write(path, cleaning_page(&args.model, &plan, audit).as_bytes())?;
    }
    if let Some(path) = &args.strand {
        output::write(path, &json(&plan.strand)?)?;
    }
    if let Some(path) = &args.report {
        let asked = (settings, args.place.shrinkage.unwrap_or_default());
        output::write(path, &json(&PlanReport::new(&args.model, asked, &repairs, &plan, audit.as_ref()))?)?;
    }

    skirt_remark(&settings, &plan).iter().for_each(|remark| tell(format_args!("note: {remark}")));
    machine::remarks(&profiles, &args.job(), &plan.strand).iter().for_each(tell);
    Ok(verdict(args, &plan, settings.width, audit.as_ref()))
}

/// Refuses what reaches beyond the printer, unless that is wanted.
fn fits(args: &PlanArgs, what: &'static str, beyond: Option<Beyond>) -> Result<(), Failure> {
    match (beyond, &args.bead.printer) {
        (Some(beyond), Some(printer)) if !args.beyond_volume => {
            Err(Failure::Beyond { what, printer: printer.clone(), beyond })
        }
        _ => Ok(()),
    }
}

/// Refuses a model that had to be repaired, by its worst defect.
fn refuse_defects(name: &str, repairs: &Repairs) -> Result<(), Failure> {
    let Some((kind, places)) = repairs.worst() else { return Ok(()) };
    let at = places.first.first().copied().unwrap_or_default();
    Err(Failure::Defect { name: name.to_owned(), kind, count: places.count, at })
}

/// Says what was planned and found; the exit status tells whether there are findings.
fn verdict(args: &PlanArgs, plan: &Plan, width: f64, audit: Option<&Report>) -> ExitCode {
    if !args.quiet {
        tell(summary(plan, width));
    }
    let missing = missing(plan, width);
    missing.iter().for_each(tell);
    let mut findings = !missing.is_empty();
    if let Some(report) = audit {
        findings |= !report.is_sound();
        if !args.quiet {
            tell(cleaning(report));
        }
        let short = report.falls_short();
        if short.is_empty() && !args.quiet {
            tell("audit: sound");
        }
        for shortfall in short {
            tell(format_args!(
                "audit: {} is {}, the limit is {}",
                shortfall.figure, shortfall.value, shortfall.limit
            ));
        }
    }
    if findings { ExitCode::from(FINDINGS) } else { ExitCode::SUCCESS }
}

fn gcode(plan: &Plan, written: &GcodeSettings) -> Result<String, Failure> {
    write_gcode(&plan.strand, written).map_err(unwritten)
}

fn unwritten(source: GcodeError) -> Failure {
    Failure::Output { what: "g-code", source: Box::new(source) }
}

/// The text that is audited: the file itself, or, where the machine is told nothing of paste, the same moves with E.
fn audited<'t>(plan: &Plan, written: &GcodeSettings, text: &'t str) -> Result<Cow<'t, str>, Failure> {
    if !matches!(written.extrusion, Extrusion::Constant { .. }) {
        return Ok(Cow::Borrowed(text));
    }
    let with_e = GcodeSettings { extrusion: Extrusion::Units, ..written.clone() };
    gcode(plan, &with_e).map(Cow::Owned)
}

/// A plan, or why there is none, and the outlines that were planned, if they are wanted.
type Planned = (Result<Plan, PlanError>, Option<Soup>);

/// Plans; fails by itself only if no threads can be had.
fn plan(mesh: &Mesh, settings: &Settings, args: &PlanArgs) -> Result<Planned, Failure> {
    let bar = PlanBar::new(args.quiet);
    let work = || {
        let mut follow = |progress| bar.follow(progress);
        if args.paper_exact {
            let mut planner = refusing_holes(literal::planner(), args);
            (planner.plan_observed(mesh, settings, &mut follow), planner.slice.kept)
        } else {
            let mut planner = refusing_holes(Planner::default(), args);
            (planner.plan_observed(mesh, settings, &mut follow), planner.slice.kept)
        }
    };
    let plan = with_threads(usize::from(args.threads), work)?;
    bar.finish();
    Ok(plan)
}

/// The same planner, which goes no further where an outline is open.
fn refusing_holes<S, G, U, R, E, T, C>(
    planner: Planner<S, G, U, R, E, T, C>,
    args: &PlanArgs,
) -> Planner<ClosedSlices<S>, G, U, R, E, T, C> {
    let Planner { slice, safeguard, support, route, smooth, taut, seam, checked } = planner;
    let slice = ClosedSlices { slice, strict: args.strict, keeps: args.repaired.is_some(), kept: None };
    Planner { slice, safeguard, support, route, smooth, taut, seam, checked }
}

/// Runs a piece of work that may spread over this many threads.
#[cfg(feature = "rayon")]
fn with_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> Result<T, Failure> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    Ok(pool.map_err(|source| Failure::Threads { threads, source })?.install(work))
}

/// Runs a piece of work; without the feature `rayon` there is one thread for it.
#[cfg(not(feature = "rayon"))]
fn with_threads<T>(_: usize, work: impl FnOnce() -> T) -> Result<T, Failure> {
    Ok(work())
}

/// The audit and the pictures; side by side where there is a thread for each.
fn audited_and_drawn(
    args: &PlanArgs,
    plan: &Plan,
    gcode: &str,
    mesh: &Mesh,
    settings: &Settings,
) -> Result<Option<Report>, Failure> {
    let _waiting = Waiting::new(if args.no_audit { "drawing" } else { "auditing" }, args.quiet);
    let audit = || (!args.no_audit).then(|| measure(gcode, mesh, settings)).transpose();
    let (report, drawn) = if args.threads > 1 {
        thread::scope(|scope| {
            let measured = scope.spawn(audit);
            let drawn = pictures(args, plan);
            (measured.join().unwrap_or_else(|panic| resume_unwind(panic)), drawn)
        })
    } else {
        (audit(), pictures(args, plan))
    };
    drawn?;
    report.map_err(|source| Failure::Output { what: "audit", source: Box::new(source) })
}

fn pictures(args: &PlanArgs, plan: &Plan) -> Result<(), Failure> {
    let overview = |wanted: bool| wanted.then(|| overview_svg(&plan.strand, &ViewStyle::default()));
    if let Some(folder) = &args.svg {
        output::folder(folder)?;
        for (position, layer) in plan.strand.layers().iter().enumerate() {
            let name = format!("layer-{:04}.svg", layer.index);
            output::write(
                &folder.join(name),
                layer_svg(&plan.strand, position, &SvgStyle::default()).as_bytes(),
            )?;
        }
    }
    if let Some(svg) = overview(args.svg.is_some() || args.png.is_some()) {
        if let Some(folder) = &args.svg {
            output::write(&folder.join("overview.svg"), svg.as_bytes())?;
        }
        if let Some(path) = &args.png {
            let bytes = png(&svg, PICTURE)
                .map_err(|source| Failure::Output { what: "picture", source: Box::new(source) })?;
            output::write(path, &bytes)?;
        }
    }
    Ok(())
}

fn json(value: &impl serde::Serialize) -> Result<Vec<u8>, Failure> {
    serde_json::to_vec_pretty(&Document(value))
        .map_err(|source| Failure::Output { what: "report", source: Box::new(source) })
}
