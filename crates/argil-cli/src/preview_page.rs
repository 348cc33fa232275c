//! The page that shows a plan: what it tells besides the strand.

use argil::gcode::GcodeSettings;
use argil::slice::Loss;
use argil::strand::Role;
use argil::{Plan, Settings};
use argil_audit::{ContactPlace, FindingKind, Report};
use argil_preview::{PageMark, PageStyle, page_html};

use crate::missing::findings;

/// The page of a plan, with the findings of its audit and the losses of its slicing.
pub(crate) fn preview_page(
    model: &str,
    settings: &Settings,
    gcode: &GcodeSettings,
    plan: &Plan,
    audit: Option<&Report>,
) -> String {
    let sound = audit.is_none_or(Report::is_sound);
    // The contacts of a layer are places of the ledger, which says why they are there.
    let in_ledger = |f: &&argil_audit::Finding| f.kind != FindingKind::Contact;
    let found = audit.into_iter().flat_map(|report| {
        let findings = report.findings.iter().filter(in_ledger).map(|f| finding(f, sound));
        findings.chain(report.contacts.iter().map(contact))
    });
    let missing = findings(&plan.losses, settings.width);
    let lost = plan.losses.iter().zip(missing).map(|(lost, missing)| loss(lost, missing));
    let style = PageStyle {
        title: format!("{} – argil", short_name(model)),
        facts: facts(settings, plan, audit),
        marks: found.chain(lost).collect(),
        speeds: [gcode.first_layer_feed, gcode.feed],
        ..PageStyle::default()
    };
    page_html(&plan.strand, &style)
}

/// A model without the folders that it is in.
pub(crate) fn short_name(model: &str) -> &str {
    model.rsplit(['/', '\\']).next().unwrap_or(model)
}

fn facts(settings: &Settings, plan: &Plan, audit: Option<&Report>) -> Vec<(String, String)> {
    let strand = &plan.strand;
    let model = strand.length_of(Role::Wall) + strand.length_of(Role::Fill);
    let beside = strand.length() - model - strand.length_of(Role::Skirt);
    let verdict = match audit {
        None => "not made".to_owned(),
        Some(report) if report.is_sound() => "sound".to_owned(),
        Some(report) => {
            let short = report.falls_short();
            let names: Vec<String> = short.iter().map(|s| s.figure.replace('_', " ")).collect();
            format!("short of {}", names.join(", "))
        }
    };
    let facts = [
        ("bead", format!("{} × {} mm", settings.width, settings.layer_height)),
        ("paste", format!("{:.1} cm³", strand.volume() / 1e3)),
        ("transfers", "0".to_owned()),
        ("beside the model", format!("{:.1} % of its length", 100.0 * beside / model.max(1e-9))),
        ("audit", verdict),
    ];
    facts.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

/// A place of the contact ledger: what has to be cleaned there.
fn contact(place: &ContactPlace) -> PageMark {
    PageMark {
        kind: format!("contact: {}", place.cause.name()),
        fault: false,
        layer: usize::try_from(place.first_layer).unwrap_or(0),
        last_layer: usize::try_from(place.last_layer).unwrap_or(0),
        at: Some([place.at.x, place.at.y].into()),
        measure: place.length,
        unit: "mm".to_owned(),
    }
}

/// A finding of the audit. What only tells what to look at, as sharp turns do, is no fault. Nor is anything in a sound
/// print, where what was found is within its limit.
fn finding(finding: &argil_audit::Finding, sound: bool) -> PageMark {
    use FindingKind::{
        BareFill, BareOutline, Contact, Jump, ManyPaths, Retraction, SelfCrossing, SharpBend, SharpTurn,
        UnreadableLine, WallCrossing,
    };
    let unit = match finding.kind {
        UnreadableLine => "line",
        ManyPaths => "paths",
        SharpTurn | SharpBend => "°",
        Retraction | SelfCrossing | WallCrossing => "",
        _ => "mm",
    };
    PageMark {
        kind: finding.kind.name().to_owned(),
        fault: !sound
            && !matches!(finding.kind, BareFill | BareOutline | Contact | Jump | SharpBend | SharpTurn),
        layer: usize::try_from(finding.layer).unwrap_or(0),
        last_layer: usize::try_from(finding.layer).unwrap_or(0),
        at: finding.at,
        measure: finding.measure,
        unit: unit.to_owned(),
    }
}

/// What of the model is not printed as it is.
fn loss(loss: &Loss, fault: bool) -> PageMark {
    let (kind, measure, unit) = match *loss {
        Loss::OpenOutline { length, .. } => ("open outline left out", length, "mm"),
        Loss::ClosedGap { gap, .. } => ("gap in an outline closed", gap, "mm"),
        Loss::Overlap { area, .. } => ("bodies that overlap made one", area, "mm²"),
        Loss::InsideOut { area, .. } => ("surface inside out", area, "mm²"),
        Loss::Stray { length, .. } => ("open piece that bounds nothing left out", length, "mm"),
        Loss::Thin { area, .. } => ("thinner than a bead", area, "mm²"),
        Loss::Narrow { length, .. } => ("part thinner than a bead", length, "mm"),
        Loss::Vanished { area, .. } => ("too small to print", area, "mm²"),
        Loss::Branch { area, .. } => ("part not reached by a bead", area, "mm²"),
        Loss::OpenSheet { length, .. } => ("open section printed there and back", length, "mm"),
        Loss::Unsound { length, .. } => ("wall left out", length, "mm"),
        _ => ("other loss", 0.0, ""),
    };
    PageMark {
        kind: kind.to_owned(),
        fault,
        layer: loss.layer(),
        last_layer: loss.layer(),
        at: Some([loss.at().x, loss.at().y].into()),
        measure,
        unit: unit.to_owned(),
    }
}
