//! How a plan is written for its machine.

use std::path::Path;
use std::{fmt, fs};

use argil::Settings;
use argil::gcode::{Extrusion, Flavour, GcodeSettings, RoleNames};
use argil::mesh::Mesh;
use argil::strand::{BeadShape, Strand};
use argil_preview::{ViewStyle, overview_svg, png, thumbnail};
use argil_printers::{Bead, Fact, Printer, render};

use crate::args::BeadArgs;
use crate::failure::Failure;
use crate::machine_args::{EMode, FlavourArg, MachineArgs, Viewer};
use crate::profiles::Profiles;

/// What is written for a machine: a plan or a test print.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Job<'a> {
    /// What is printed, as it was named.
    pub(crate) model: &'a str,
    pub(crate) bead: &'a BeadArgs,
    pub(crate) machine: &'a MachineArgs,
}

/// The settings of the g-code as far as they are known before there is a plan: options first, then the printer, then the
/// material, then defaults. What cannot be is refused here, so that no long plan ends with it.
pub(crate) fn gcode_settings(
    job: &Job<'_>,
    settings: &Settings,
    profiles: &Profiles,
) -> Result<GcodeSettings, Failure> {
    let machine = job.machine;
    let usual = GcodeSettings::default();
    let printer = profiles.printer.as_ref();
    let of = |fact: fn(&Printer) -> &Fact<f64>| printer.and_then(|p| fact(p).value()).copied();
    let feed_of_material = profiles.material.as_ref().and_then(|m| m.feed.value()).copied();
    let slow = machine.feed.map(|feed| feed.min(usual.first_layer_feed));
    let first_layer_feed = machine.first_layer_feed.or(of(|p| &p.first_layer_feed)).or(slow);
    let relative_of_printer = printer.and_then(|p| p.relative_e.value()).copied();
    let written = GcodeSettings {
        flavour: flavour(machine, printer),
        extrusion: extrusion(machine, printer),
        mm3_per_e: machine.mm3_per_e.or(of(|p| &p.mm3_per_e)).unwrap_or(usual.mm3_per_e),
        relative_e: match machine.e {
            Some(mode) => mode == EMode::Relative,
            None => relative_of_printer.unwrap_or(usual.relative_e),
        },
        bead: match printer.and_then(|p| p.bead.value()) {
            Some(Bead::Box) => BeadShape::Box,
            _ => usual.bead,
        },
        feed: machine.feed.or(of(|p| &p.feed)).or(feed_of_material).unwrap_or(usual.feed),
        first_layer_feed: first_layer_feed.unwrap_or(usual.first_layer_feed),
        approach_feed: machine.travel_feed.or(of(|p| &p.travel_feed)).unwrap_or(usual.approach_feed),
        arc_tolerance: machine.arcs,
        wipe: machine.wipe,
        line_numbers: machine.line_numbers,
        names: match machine.viewer {
            Viewer::PrusaSlicer => RoleNames::prusa_slicer(),
            Viewer::OrcaSlicer => RoleNames::orca_slicer(),
            Viewer::Cura => RoleNames::cura(),
        },
        header: header(job, settings),
        start: template(machine.start.as_deref(), printer.map(|p| &p.start))?,
        end: template(machine.end.as_deref(), printer.map(|p| &p.end))?,
        ..usual
    };
    written.check().map_err(|source| Failure::Machine { source })?;
    let nothing: Vec<(&str, String)> = NAMES.map(|name| (name, String::new())).to_vec();
    for (name, code) in [("start code", &written.start), ("end code", &written.end)] {
        render(code, &nothing).map_err(|source| Failure::input(name, source))?;
    }
    Ok(written)
}

/// A file's text, or else the printer's.
fn template(file: Option<&Path>, fact: Option<&Fact<String>>) -> Result<String, Failure> {
    match file {
        Some(path) => fs::read_to_string(path).map_err(|source| Failure::reading(path, source)),
        None => Ok(fact.and_then(Fact::value).cloned().unwrap_or_default()),
    }
}

/// Adds what only the plan tells: the thumbnail, and what names in braces stand for.
pub(crate) fn complete(written: &mut GcodeSettings, job: &Job<'_>, strand: &Strand) -> Result<(), Failure> {
    if let Some(pixels) = job.machine.thumbnail {
        let svg = overview_svg(strand, &ViewStyle { bed: false, ..ViewStyle::default() });
        let failed = |source| Failure::Output { what: "thumbnail", source: Box::new(source) };
        written.preface = thumbnail(&png(&svg, pixels).map_err(failed)?);
    }
    let values = values(job, strand, written);
    for (name, code) in [("start code", &mut written.start), ("end code", &mut written.end)] {
        *code = render(code, &values).map_err(|source| Failure::input(name, source))?;
    }
    Ok(())
}

fn flavour(machine: &MachineArgs, printer: Option<&Printer>) -> Flavour {
    let of_printer = printer.and_then(|p| p.flavour.value()).map(|flavour| match flavour {
        argil_printers::Flavour::RepRapFirmware => Flavour::RepRapFirmware,
        argil_printers::Flavour::Klipper => Flavour::Klipper,
        argil_printers::Flavour::Marlin | argil_printers::Flavour::Poses => Flavour::Marlin,
    });
    let given = machine.flavour.map(|flavour| match flavour {
        FlavourArg::Marlin => Flavour::Marlin,
        FlavourArg::RepRapFirmware => Flavour::RepRapFirmware,
        FlavourArg::Klipper => Flavour::Klipper,
    });
    given.or(of_printer).unwrap_or_default()
}

fn extrusion(machine: &MachineArgs, printer: Option<&Printer>) -> Extrusion {
    let known = |fact: Option<&Fact<f64>>| fact.and_then(Fact::value).copied();
    let diameter = known(printer.and_then(|p| p.volumetric_diameter.as_ref()));
    let rate = known(printer.and_then(|p| p.constant_rate.as_ref()));
    match (machine.volumetric, machine.constant_rate, machine.mm3_per_e) {
        (Some(diameter), ..) => Extrusion::Volumetric { diameter },
        (_, Some(rate), _) => Extrusion::Constant { rate },
        (.., Some(_)) => Extrusion::Units,
        _ => match (diameter, rate) {
            (Some(diameter), _) => Extrusion::Volumetric { diameter },
            (_, Some(rate)) => Extrusion::Constant { rate },
            _ => Extrusion::Units,
        },
    }
}

fn header(job: &Job<'_>, settings: &Settings) -> Vec<(String, String)> {
    let mut header = vec![
        ("model", job.model.to_owned()),
        ("width", settings.width.to_string()),
        ("layer height", settings.layer_height.to_string()),
        ("walls", settings.walls.to_string()),
        ("across", settings.material.across.to_string()),
        ("along", settings.material.along.to_string()),
    ];
    header.extend(job.bead.printer.iter().map(|name| ("printer", name.clone())));
    header.extend(job.bead.material.iter().map(|name| ("material", name.clone())));
    header.into_iter().map(|(key, value)| (key.to_owned(), value)).collect()
}

/// The names that may stand in braces in start and end code.
const NAMES: [&str; 12] = [
    "first_x",
    "first_y",
    "first_z",
    "approach_z",
    "last_x",
    "last_y",
    "last_z",
    "leave_z",
    "feed",
    "travel_feed",
    "layers",
    "model",
];

/// What they stand for: places in mm, speeds in mm/min as F takes them.
fn values(job: &Job<'_>, strand: &Strand, written: &GcodeSettings) -> Vec<(&'static str, String)> {
    let layers = strand.layers();
    let (first, last) = (layers.first().map_or(0.0, |l| l.z), layers.last().map_or(0.0, |l| l.z));
    let numbers = [
        strand.start().x,
        strand.start().y,
        first,
        first + written.lift,
        strand.end().x,
        strand.end().y,
        last,
        last + written.lift,
        written.feed * 60.0,
        written.approach_feed * 60.0,
        layers.len() as f64,
    ];
    let texts = numbers.map(|value| ((value * 1e4).round() / 1e4).to_string());
    // A name with a line's end in it would go on as code.
    let model = job.model.replace(char::is_control, " ");
    NAMES.into_iter().zip(texts.into_iter().chain([model])).collect()
}

/// What is to be said about a plan on its printer: what was taken because it is unknown, and whether it fits.
pub(crate) fn remarks(profiles: &Profiles, job: &Job<'_>, strand: &Strand) -> Vec<String> {
    let mut remarks = Vec::new();
    if let (Some(name), Some(material)) = (&job.bead.material, &profiles.material) {
        let facts =
            [("overhang", &material.overhang, job.bead.across), ("bridge", &material.bridge, job.bead.along)];
        for (what, fact, given) in facts {
            if fact.value().is_none() && given.is_none() {
                remarks.push(format!(
                    "the {what} that {name} bears is unknown: that of the paper's clay is taken; `argil calibrate` \
                     finds your own"
                ));
            }
        }
    }
    remarks.extend(unknown_flow(profiles, job));
    remarks.extend(misfit(profiles, job, strand));
    remarks
}

/// What was taken because the printer's flow is unknown.
pub(crate) fn unknown_flow(profiles: &Profiles, job: &Job<'_>) -> Option<String> {
    let (name, printer) = (job.bead.printer.as_ref()?, profiles.printer.as_ref()?);
    let machine = job.machine;
    let other_e =
        machine.mm3_per_e.is_some() || machine.volumetric.is_some() || machine.constant_rate.is_some();
    let why = printer.mm3_per_e.unknown().filter(|_| !other_e && !is_robot(profiles))?;
    Some(format!("mm3_per_e of {name} is unknown ({why}): 2.405 is taken; set it by --mm3-per-e"))
}

/// A warning where a strand reaches beyond its printer, and is written all the same.
pub(crate) fn misfit(profiles: &Profiles, job: &Job<'_>, strand: &Strand) -> Option<String> {
    let (name, beyond) = (job.bead.printer.as_ref()?, strand_beyond(profiles, strand)?);
    Some(format!("warning: the print reaches {beyond}, beyond {name}"))
}

/// The box of a print or a model that its printer does not reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Beyond {
    low: [f64; 3],
    high: [f64; 3],
}

impl fmt::Display for Beyond {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { low, high } = self;
        write!(
            f,
            "from ({:.1}, {:.1}) to ({:.1}, {:.1}) and {:.1} mm up",
            low[0], low[1], high[0], high[1], high[2]
        )
    }
}

/// The box of a strand, if the printer does not reach all of its beads; `None` also where it is not known what it reaches.
pub(crate) fn strand_beyond(profiles: &Profiles, strand: &Strand) -> Option<Beyond> {
    let beads = strand.layers().iter().flat_map(|layer| {
        let (half, z) = (layer.width / 2.0, layer.z);
        layer.moves.iter().map(move |step| {
            ([step.to.x - half, step.to.y - half, z], [step.to.x + half, step.to.y + half, z])
        })
    });
    beyond(profiles, beads)
}

/// The same of a model, which is as wide as its beads will be, without their support.
pub(crate) fn model_beyond(profiles: &Profiles, mesh: &Mesh) -> Option<Beyond> {
    beyond(profiles, mesh.vertices().iter().map(|&vertex| (vertex, vertex)))
}

fn beyond(profiles: &Profiles, boxes: impl Iterator<Item = ([f64; 3], [f64; 3])>) -> Option<Beyond> {
    let printer = profiles.printer.as_ref()?;
    let mut all = Beyond { low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] };
    let mut reaches = true;
    for (low, high) in boxes {
        reaches &= printer.reaches(low, high)?;
        for axis in 0..3 {
            all.low[axis] = all.low[axis].min(low[axis]);
            all.high[axis] = all.high[axis].max(high[axis]);
        }
    }
    (!reaches).then_some(all)
}

/// Whether the printer takes a table of poses in place of g-code.
pub(crate) fn is_robot(profiles: &Profiles) -> bool {
    let flavour = profiles.printer.as_ref().and_then(|p| p.flavour.value());
    flavour == Some(&argil_printers::Flavour::Poses)
}
