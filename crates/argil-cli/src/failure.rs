//! Failures: what went wrong, and the exit status that tells a script.

use std::fmt;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use argil::mesh::{Format, MeshError};

use crate::machine::Beyond;

/// The plan stands or the file was read, but there are findings.
pub(crate) const FINDINGS: u8 = 4;
const BAD_INPUT: u8 = 3;
const USAGE: u8 = 2;

/// Why the program stops.
#[derive(Debug)]
pub(crate) enum Failure {
    /// A file cannot be read or written.
    File { path: PathBuf, doing: &'static str, source: std::io::Error },
    /// The model or g-code is not usable.
    Input { name: String, source: Box<dyn std::error::Error> },
    /// The model's file is of no format that is read.
    Format { name: String },
    /// Layers come in another height than they are to be printed in.
    LayerHeight { name: String, given: f64, planned: f64 },
    /// More than is taken.
    TooLarge { name: String, what: &'static str, found: u64, limit: u64, unit: &'static str },
    /// Slicing would take more memory than it may.
    Memory { name: String, needed: f64, given: f64 },
    /// The model has a defect, and is not to be repaired.
    Defect { name: String, kind: &'static str, count: usize, at: [f64; 3] },
    /// There is no such bundled model.
    Sample { name: String },
    /// There is no such printer or material.
    Profile { what: &'static str, name: String, list: &'static str, near: Option<&'static str> },
    /// A file of options has a key or a value that cannot be.
    Config { file: String, key: String, why: String },
    /// The machine cannot be written for like this.
    Machine { source: argil::gcode::GcodeError },
    /// The printer does not reach all of a model or of its print.
    Beyond { what: &'static str, printer: String, beyond: Beyond },
    /// The bed is to be centred on, but no printer is given whose bed is known.
    NoBed,
    /// An option has a value that cannot be.
    Option { option: String, source: argil::PlanError },
    /// The model has no plan.
    Plan { name: String, source: argil::PlanError },
    /// The result cannot be written as g-code or a picture.
    Output { what: &'static str, source: Box<dyn std::error::Error> },
    /// The threads that were asked for cannot be had.
    #[cfg(feature = "rayon")]
    Threads { threads: usize, source: rayon::ThreadPoolBuildError },
}

impl Failure {
    pub(crate) fn reading(path: &Path, source: std::io::Error) -> Self {
        Self::File { path: path.to_owned(), doing: "read", source }
    }

    pub(crate) fn writing(path: &Path, source: std::io::Error) -> Self {
        Self::File { path: path.to_owned(), doing: "write", source }
    }

    pub(crate) fn input(name: &str, source: impl std::error::Error + 'static) -> Self {
        Self::Input { name: name.to_owned(), source: Box::new(source) }
    }

    /// A model that does not follow its format.
    pub(crate) fn reading_as(name: &str, format: Format, source: MeshError) -> Self {
        Self::Input { name: format!("{name}, read as {format}"), source: Box::new(source) }
    }

    /// A file of layers that cannot be read.
    pub(crate) fn layers(name: &str, source: impl std::error::Error + 'static) -> Self {
        Self::Input { name: format!("{name}, read as layers"), source: Box::new(source) }
    }

    /// A setting that cannot be, under the name that it has on the command line.
    pub(crate) fn option(source: argil::PlanError) -> Self {
        let name = match &source {
            argil::PlanError::Setting { name, .. } => name.rsplit('.').next().unwrap_or(name),
            _ => "settings",
        };
        Self::Option { option: format!("--{}", name.replace('_', "-")), source }
    }

    pub(crate) fn exit_code(&self) -> ExitCode {
        ExitCode::from(match self {
            Self::Sample { .. } | Self::Profile { .. } | Self::Config { .. } | Self::NoBed => USAGE,
            Self::Plan { source, .. } if !is_input(source) => FINDINGS,
            _ => BAD_INPUT,
        })
    }
}

/// Whether a plan fails because of what it was given, and not in a layer.
fn is_input(error: &argil::PlanError) -> bool {
    use argil::PlanError::{Nothing, Setting, Slice};
    matches!(error, Setting { .. } | Slice(_) | Nothing)
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File { path, doing, source } => write!(f, "cannot {doing} {}: {source}", path.display()),
            Self::Input { name, source } => write!(f, "{name}: {source}"),
            Self::Format { name } => {
                write!(
                    f,
                    "{name}: no STL, OBJ, PLY or 3MF file, and no layers in SVG or JSON; export the model as one of these"
                )
            }
            Self::LayerHeight { name, given, planned } => {
                write!(
                    f,
                    "{name}: its layers are {given} mm high, the plan's {planned} mm; say --layer-height {given}"
                )
            }
            Self::TooLarge { name, what, found, limit, unit } => {
                write!(f, "{name}: {what} of {found} {unit} is more than {limit}; reduce the mesh first")
            }
            Self::Memory { name, needed, given } => write!(
                f,
                "{name}: slicing it is estimated to take {needed:.1} GiB of memory, more than {given}; reduce the mesh, or \
                 allow more by --memory"
            ),
            Self::Defect { name, kind, count, at: [x, y, z] } => {
                write!(
                    f,
                    "{name}: {count} {kind}, the first at ({x:.2}, {y:.2}, {z:.2}); --strict repairs nothing"
                )
            }
            Self::Sample { name } => {
                write!(f, "there is no bundled model `{name}`; `argil samples` lists them")
            }
            Self::Profile { what, name, list, near } => {
                write!(f, "there is no {what} `{name}`; `{list}` lists them")?;
                near.iter().try_for_each(|near| write!(f, ", among them `{near}`"))
            }
            Self::Config { file, key, why } => write!(f, "{file}: {key}: {why}"),
            Self::Machine { source } => match source {
                argil::gcode::GcodeError::Setting { name, value, must_be } => {
                    write!(f, "{}: {value} must be {must_be}", machine_option(name))
                }
                _ => write!(f, "{source}"),
            },
            Self::Beyond { what, printer, beyond } => write!(
                f,
                "the {what} reaches {beyond}, beyond {printer}\n       nothing was written; --place bed centres it, --scale or --height \
                 makes it smaller, --beyond-volume writes it all the same"
            ),
            Self::NoBed => write!(f, "--place bed: needs a --printer whose bed is known"),
            Self::Option { option, source } => write!(f, "{option}: {source}"),
            Self::Plan { name, source } => {
                write!(f, "{name}: {source}")?;
                advice(source).iter().try_for_each(|advice| write!(f, "\n       {advice}"))
            }
            Self::Output { what, source } => write!(f, "the {what} cannot be written: {source}"),
            #[cfg(feature = "rayon")]
            Self::Threads { threads, source } => write!(f, "{threads} threads cannot be had: {source}"),
        }
    }
}

/// What can be done about a model that has no plan.
fn advice(error: &argil::PlanError) -> Option<&'static str> {
    use argil::PlanError::{Layer, Nothing, Seam, Slice};
    match error {
        Nothing => Some(
            "try a smaller --width, a larger --scale if the file is not in millimetres, or --surface if the model is a sheet \
             without thickness",
        ),
        Slice(argil::slice::SliceError::ThinnerThanALayer { .. }) => {
            Some("try a smaller --layer-height, or a larger --scale if the file is not in millimetres")
        }
        Slice(argil::slice::SliceError::TooManyLayers { .. } | argil::slice::SliceError::TooWide { .. }) => {
            Some("try --height, or --scale 0.001 if the file is in micrometres")
        }
        Slice(argil::slice::SliceError::Open { .. }) => Some(
            "nothing was written; close the hole in the program that the model was made in, or with one that repairs meshes; if \
             the model is a sheet without thickness, say --surface",
        ),
        Slice(argil::slice::SliceError::InsideOut { .. }) => Some(
            "nothing was written; turn the surface round in the program that the model was made in, or join the bodies there",
        ),
        Slice(argil::slice::SliceError::Overlap { .. }) => {
            Some("nothing was written; without --strict bodies that overlap are made one")
        }
        Slice(argil::slice::SliceError::Gap { .. }) => {
            Some("nothing was written; without --strict the gap is closed with a straight line")
        }
        Layer { .. } | Seam(_) => Some(
            "nothing was written; try another --layer-height or a smaller --width, or a paste that bears more (--across, --along)",
        ),
        _ => None,
    }
}

/// The name on the command line of a setting of the g-code.
fn machine_option(setting: &str) -> String {
    let name = match setting {
        "approach_feed" => "travel-feed",
        "arc_tolerance" => "arcs",
        "diameter" => "volumetric",
        "rate" => "constant-rate",
        other => other,
    };
    format!("--{}", name.replace('_', "-"))
}
