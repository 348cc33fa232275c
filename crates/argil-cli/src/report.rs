//! What the program says about a plan: a summary for people, JSON for programs.

use argil::mesh::Repairs;
use argil::slice::Loss;
use argil::strand::Role;
use argil::{Climb, InfillChoice, LayerReport, LevelCause, Plan, Settings, SkirtLaid};
use argil_audit::{ContactCause, Report};
use serde::Serialize;

use crate::missing::findings;
use crate::shrinkage::Shrinkage;

/// The report as it is written.
#[derive(Serialize)]
pub(crate) struct PlanReport<'a> {
    program: &'static str,
    version: &'static str,
    model: &'a str,
    settings: Settings,
    /// Per cent that the model was enlarged to make up for, x, y, z.
    shrinkage: Shrinkage,
    repairs: RepairsReport,
    layers: usize,
    transfers: usize,
    strand_mm: f64,
    wall_mm: f64,
    fill_mm: f64,
    infill_mm: f64,
    support_mm: f64,
    connection_mm: f64,
    seam_mm: f64,
    skirt_mm: f64,
    volume_mm3: f64,
    /// The skirt as it was laid.
    skirt: Option<SkirtLaid>,
    #[serde(skip_serializing_if = "Option::is_none")]
    infill: Option<InfillChoice>,
    per_layer: &'a [LayerReport],
    losses: Vec<LossReport>,
    #[serde(skip_serializing_if = "Option::is_none")]
    audit: Option<&'a Report>,
}

/// Something of the model that is not printed as it is.
#[derive(Serialize)]
struct LossReport {
    kind: &'static str,
    layer: usize,
    at: [f64; 2],
    measure: f64,
    /// Whether it is missing from the print, which the exit status tells.
    finding: bool,
}

/// What was repaired before there was a mesh to plan.
#[derive(Serialize)]
struct RepairsReport {
    shells: usize,
    welded_vertices: usize,
    defects: Vec<DefectReport>,
}

/// A kind of defect, how often it was met, and the first places in millimetres of the file's coordinates.
#[derive(Serialize)]
struct DefectReport {
    kind: &'static str,
    count: usize,
    first_at: Vec<[f64; 3]>,
}

impl RepairsReport {
    fn new(repairs: &Repairs) -> Self {
        let met = repairs.listed().into_iter().filter(|(_, places)| places.count > 0);
        let defects = met.map(|(kind, places)| DefectReport {
            kind,
            count: places.count,
            first_at: places.first.clone(),
        });
        Self { shells: repairs.shells, welded_vertices: repairs.welded, defects: defects.collect() }
    }
}

impl<'a> PlanReport<'a> {
    pub(crate) fn new(
        model: &'a str,
        (settings, shrinkage): (Settings, Shrinkage),
        repairs: &Repairs,
        plan: &'a Plan,
        audit: Option<&'a Report>,
    ) -> Self {
        let strand = &plan.strand;
        let width = settings.width;
        Self {
            program: "argil",
            version: env!("CARGO_PKG_VERSION"),
            model,
            settings,
            shrinkage,
            repairs: RepairsReport::new(repairs),
            layers: strand.layers().len(),
            // A strand is one polyline: there is no way to hold a transfer in it.
            transfers: 0,
            strand_mm: strand.length(),
            wall_mm: strand.length_of(Role::Wall),
            fill_mm: strand.length_of(Role::Fill),
            infill_mm: infill_length(plan),
            support_mm: strand.length_of(Role::Support),
            connection_mm: strand.length_of(Role::Connection),
            seam_mm: strand.length_of(Role::Seam),
            skirt_mm: strand.length_of(Role::Skirt),
            volume_mm3: strand.volume(),
            skirt: plan.skirt,
            infill: plan.infill,
            per_layer: &plan.layers,
            losses: losses(plan, width),
            audit,
        }
    }
}

/// What of the model is not printed as it is.
fn losses(plan: &Plan, width: f64) -> Vec<LossReport> {
    plan.losses.iter().zip(findings(&plan.losses, width)).map(|(lost, finding)| loss(lost, finding)).collect()
}

fn loss(loss: &Loss, finding: bool) -> LossReport {
    let (kind, measure) = match *loss {
        Loss::OpenOutline { length, .. } => ("open outline, mm left out", length),
        Loss::ClosedGap { gap, .. } => ("gap in an outline closed, mm wide", gap),
        Loss::Stray { length, .. } => ("open piece that bounds nothing left out, mm", length),
        Loss::Overlap { area, .. } => ("bodies that overlap made one, mm²", area),
        Loss::InsideOut { area, .. } => ("surface inside out, mm²", area),
        Loss::Thin { area, .. } => ("thinner than a bead, mm²", area),
        Loss::Narrow { length, .. } => ("part thinner than a bead, mm of its middle line", length),
        Loss::Vanished { area, .. } => ("too small to print, mm²", area),
        Loss::Branch { area, .. } => ("part not reached by a bead, mm²", area),
        Loss::OpenSheet { length, .. } => ("open section printed there and back, mm", length),
        Loss::Unsound { length, .. } => ("wall left out, mm", length),
        _ => ("other", 0.0),
    };
    LossReport { kind, layer: loss.layer(), at: [loss.at().x, loss.at().y], measure, finding }
}

/// The summary at the end of a plan.
pub(crate) fn summary(plan: &Plan, width: f64) -> String {
    let strand = &plan.strand;
    let fill = strand.length_of(Role::Fill);
    let model = strand.length_of(Role::Wall) + fill;
    let rest = strand.length() - model - strand.length_of(Role::Skirt);
    let mut text = format!(
        "{} layers in one strand of {:.2} m, {:.1} cm³ of paste, 0 transfers\n\
         model {:.2} m, beside the model {:.2} m (ratio {:.3})\n",
        strand.layers().len(),
        strand.length() / 1e3,
        strand.volume() / 1e3,
        model / 1e3,
        rest / 1e3,
        rest / model.max(1e-9),
    );
    if fill > 0.0 {
        text.push_str(&format!("of the model, fill {:.2} m", fill / 1e3));
        let sparse = infill_length(plan);
        if sparse > 0.0 {
            text.push_str(&format!(", {:.2} m of it infill", sparse / 1e3));
        }
        text.push_str(&format!(", its beads {:.2} mm wide in the mean", mean_fill_width(plan)));
        let bare = plan.layers.iter().map(|layer| layer.widest_bare).fold(0.0, f64::max);
        if bare > 0.0 {
            text.push_str(&format!("; widest place in it without a bead {bare:.2} mm"));
        }
        text.push('\n');
    }
    if let Some(skirt) = plan.skirt {
        text.push_str(&format!("skirt: {} turns, {:.2} m\n", skirt.turns, skirt.length / 1e3));
    }
    text.push_str(&climb(plan));
    if let Some((mean, layers)) = outer_ahead(plan) {
        text.push_str(&format!(
            "of the outer walls {:.0} % come before the others, in the mean of {layers} layers\n",
            100.0 * mean
        ));
    }
    if let Some(InfillChoice { taken, with_mm, without_mm }) = plan.infill {
        let told =
            |length: Option<f64>| length.map_or("no plan".to_owned(), |mm| format!("{:.2} m", mm / 1e3));
        let chosen = if taken { "infill" } else { "support from the walls" };
        text.push_str(&format!(
            "what holds the skins: {chosen}; with infill {}, without {}\n",
            told(with_mm),
            told(without_mm)
        ));
    }
    for (kind, count, first) in kinds(losses(plan, width).into_iter().filter(|loss| !loss.finding)) {
        text.push_str(&format!(
            "note: {count} places: {kind}, the first in layer {} at ({:.2}, {:.2})\n",
            first.layer, first.at[0], first.at[1]
        ));
    }
    let times: Vec<String> = plan
        .times
        .listed()
        .iter()
        .map(|(name, time)| format!("{name} {:.0}", time.as_secs_f64() * 1e3))
        .collect();
    text.push_str(&format!(
        "time in ms: {} = {:.0}",
        times.join(", "),
        plan.times.total().as_secs_f64() * 1e3
    ));
    text
}

/// The most runs of level layers that the summary names for one reason.
const RUNS_NAMED: usize = 6;

/// The share of outer walls that come before the others, in the mean of the layers that have others, and how many these are.
fn outer_ahead(plan: &Plan) -> Option<(f64, usize)> {
    let shares: Vec<f64> = plan.layers.iter().filter_map(|layer| layer.outer_ahead).collect();
    (!shares.is_empty()).then(|| (shares.iter().sum::<f64>() / shares.len() as f64, shares.len()))
}

/// How many layers of a spiral rise, and which lie level for what reason; nothing of other plans.
fn climb(plan: &Plan) -> String {
    if plan.layers.iter().all(|layer| layer.level_because.is_none()) {
        return String::new();
    }
    let rising = plan.layers.iter().filter(|layer| layer.climb == Climb::Rising).count();
    let mut text = format!("spiral: {rising} of {} layers rise", plan.layers.len());
    for (cause, why) in [
        (LevelCause::Bed, "on the bed"),
        (LevelCause::Order, "in another order than the layer below"),
        (LevelCause::Short, "too short to rise"),
        (LevelCause::Few, "too few between level ones"),
        (LevelCause::Rim, "the rim"),
    ] {
        let runs = plan.layers.chunk_by(|a, b| a.level_because == b.level_because && a.index + 1 == b.index);
        let of_cause = runs.filter(|run| run.iter().all(|layer| layer.level_because == Some(cause)));
        let named: Vec<String> = of_cause
            .filter_map(|run| {
                let (first, last) = (run.first()?.index, run.last()?.index);
                Some(if first == last { first.to_string() } else { format!("{first} to {last}") })
            })
            .collect();
        if !named.is_empty() {
            let more = if named.len() > RUNS_NAMED { ", …" } else { "" };
            let shown = named[..named.len().min(RUNS_NAMED)].join(", ");
            text.push_str(&format!("; level {shown}{more}: {why}"));
        }
    }
    let ramps: Vec<f64> = plan.layers.iter().map(|layer| layer.ramp).filter(|&ramp| ramp > 0.0).collect();
    if !ramps.is_empty() {
        let mean = 100.0 * ramps.iter().sum::<f64>() / ramps.len() as f64;
        text.push_str(&format!(
            "; {} of the level ones begin with a ramp, for {mean:.0} % of the step",
            ramps.len()
        ));
    }
    text + "\n"
}

/// What is to be said where the skirt is not what was asked for.
pub(crate) fn skirt_remark(settings: &Settings, plan: &Plan) -> Option<String> {
    let asked = settings.skirt?;
    let Some(laid) = plan.skirt else {
        return Some("no skirt: it has no room on the bed, or no way from it to the part".to_owned());
    };
    let nearer = laid.distance < (asked.distance - 1e-9) * settings.width;
    (laid.turns < asked.turns || nearer).then(|| {
        format!("the bed has room for {} turns of skirt, {:.1} mm from the part", laid.turns, laid.distance)
    })
}

/// Mean width of the beads of fill over their length, mm.
fn mean_fill_width(plan: &Plan) -> f64 {
    let fill = plan.strand.steps().filter(|step| step.role == Role::Fill);
    let [area, length] = fill
        .fold([0.0; 2], |[area, length], step| [area + step.length() * step.width, length + step.length()]);
    if length > 0.0 { area / length } else { 0.0 }
}

/// Length of infill, mm.
fn infill_length(plan: &Plan) -> f64 {
    plan.layers.iter().map(|layer| layer.infill_length).sum()
}

/// What an audit says beside its verdict: how the strand follows itself, and what there is to clean.
pub(crate) fn cleaning(report: &Report) -> String {
    let f = &report.figures;
    let mut text = format!(
        "coherence: {:.2} w from layer to layer, {:.2} % of the strand beside the model jumps\n\
         touches the model outside:",
        f.coherence_widths,
        100.0 * f.jumps_fraction,
    );
    let causes = report.contacts_by_cause();
    if causes.is_empty() {
        text.push_str(" nowhere");
    }
    for (k, (cause, places, length)) in causes.into_iter().enumerate() {
        let separator = if k == 0 { "" } else { "," };
        let cut = if cause == ContactCause::Root { " (cut there)" } else { "" };
        text.push_str(&format!("{separator} {}{cut} {places} places {length:.0} mm", cause.name()));
    }
    text
}

/// What is missing from the print, a line a kind, with the place where most of it is; nothing where all is there.
pub(crate) fn missing(plan: &Plan, width: f64) -> Vec<String> {
    let mut missing: Vec<LossReport> = losses(plan, width).into_iter().filter(|loss| loss.finding).collect();
    missing.sort_by(|a, b| b.measure.total_cmp(&a.measure));
    let line = |(kind, count, most): (String, usize, LossReport)| {
        let [x, y] = most.at;
        let unit = if most.kind.contains("mm²") { "mm²" } else { "mm" };
        format!(
            "missing: {count} places: {kind}, most of it {:.1} {unit} in layer {} at ({x:.2}, {y:.2})",
            most.measure, most.layer
        )
    };
    kinds(missing.into_iter()).into_iter().map(line).collect()
}

/// How many losses there are of each kind, and the first one.
fn kinds(losses: impl Iterator<Item = LossReport>) -> Vec<(String, usize, LossReport)> {
    let mut kinds: Vec<(String, usize, LossReport)> = Vec::new();
    for loss in losses {
        let name = loss.kind.split(',').next().unwrap_or_default();
        match kinds.iter_mut().find(|(kind, ..)| kind == name) {
            Some((_, count, _)) => *count += 1,
            None => kinds.push((name.to_owned(), 1, loss)),
        }
    }
    kinds
}
