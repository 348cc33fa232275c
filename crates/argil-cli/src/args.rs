//! The command line.

use std::path::PathBuf;

use clap::{Parser, Subcommand, ValueEnum};

/// Plans clay prints in one unbroken strand, and audits any g-code file.
#[derive(Debug, Parser)]
#[command(name = "argil", version, about, long_about = None, after_help = EXIT_STATUS)]
pub(crate) struct Args {
    #[command(subcommand)]
    pub(crate) command: Command,
}

const EXIT_STATUS: &str = "Exit status: 0 done, 2 wrong usage, 3 bad input, 4 a plan or file with findings.";

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Plan a model: one strand from the first gram of clay to the last.
    #[command(after_help = PLAN_EXAMPLES)]
    Plan(PlanArgs),
    /// Measure a g-code file of any slicer against its model, by geometry alone.
    #[command(after_help = EXIT_STATUS)]
    Audit(AuditArgs),
    /// List the bundled models; plan one with `argil plan sample:NAME`.
    Samples,
}

const PLAN_EXAMPLES: &str = "Examples:
  argil plan vase.stl -o vase.gcode
  argil plan vase.stl -o vase.gcode --width 3 --layer-height 1 --height 120 --place center
  argil plan sample:cup -o cup.gcode --preview cup.html
  argil plan sample:cup -o cup.gcode --svg layers --report cup.json

Exit status: 0 done, 2 wrong usage, 3 bad input, 4 a plan with findings.";

/// What a model is printed with.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct BeadArgs {
    /// Bead width in mm.
    #[arg(long, value_name = "MM", default_value_t = 1.5, allow_negative_numbers = true)]
    pub(crate) width: f64,
    /// Layer height in mm [default: a third of the width].
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    pub(crate) layer_height: Option<f64>,
    /// Walls side by side along every outline.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(crate) walls: usize,
    /// How far a bead may lie beside the one below, in bead widths.
    #[arg(long, value_name = "RATIO", default_value_t = 0.3, allow_negative_numbers = true)]
    pub(crate) across: f64,
    /// The longest bridge along the strand, in bead widths.
    #[arg(long, value_name = "RATIO", default_value_t = 1.6, allow_negative_numbers = true)]
    pub(crate) along: f64,
}

/// Where a model stands and how large it is.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct PlaceArgs {
    /// Keep the model's X and Y, or centre it on the origin. It always stands on z = 0.
    #[arg(long, value_enum, default_value_t = Place::Keep)]
    pub(crate) place: Place,
    /// Scale the model by this factor.
    #[arg(long, value_name = "F", conflicts_with = "height", allow_negative_numbers = true)]
    pub(crate) scale: Option<f64>,
    /// Scale the model to this height in mm.
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    pub(crate) height: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Place {
    /// Keep the model's own X and Y.
    Keep,
    /// Put the middle of the model on the origin.
    Center,
}

#[derive(Debug, clap::Args)]
pub(crate) struct PlanArgs {
    /// The model: an STL file (binary or ASCII), or sample:NAME.
    #[arg(value_name = "MODEL")]
    pub(crate) model: String,
    /// Where the g-code goes.
    #[arg(short, long, value_name = "OUT.gcode")]
    pub(crate) output: PathBuf,
    /// Write what is known about the plan as JSON.
    #[arg(long, value_name = "OUT.json")]
    pub(crate) report: Option<PathBuf>,
    /// Write the finished strand as JSON: layers of points with roles.
    #[arg(long, value_name = "OUT.json")]
    pub(crate) strand: Option<PathBuf>,
    /// Write a picture of every layer, and an overview, into this folder.
    #[arg(long, value_name = "DIR")]
    pub(crate) svg: Option<PathBuf>,
    /// Write a page for the browser that shows the beads in space, and the findings of the audit.
    #[arg(long, value_name = "OUT.html")]
    pub(crate) preview: Option<PathBuf>,
    /// Write an overview picture.
    #[arg(long, value_name = "OUT.png")]
    pub(crate) png: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) bead: BeadArgs,
    #[command(flatten)]
    pub(crate) place: PlaceArgs,
    /// Follow the paper's text literally where it is definite. For comparison: such a plan is not sound.
    #[arg(long)]
    pub(crate) paper_exact: bool,
    /// Do not measure the finished g-code.
    #[arg(long)]
    pub(crate) no_audit: bool,
    /// How many threads to use. The result is the same for any number.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: u16,
}

#[derive(Debug, clap::Args)]
pub(crate) struct AuditArgs {
    /// The g-code file.
    #[arg(value_name = "OUT.gcode")]
    pub(crate) gcode: PathBuf,
    /// The model that it was made from: an STL file, or sample:NAME.
    #[arg(long, value_name = "MODEL")]
    pub(crate) model: String,
    /// Bead width that the tolerances of the audit are meant for, in mm [default: the bead's width].
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    pub(crate) tolerance_width: Option<f64>,
    /// Write the figures as JSON.
    #[arg(long, value_name = "OUT.json")]
    pub(crate) json: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) bead: BeadArgs,
    #[command(flatten)]
    pub(crate) place: PlaceArgs,
}
