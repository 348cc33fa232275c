//! The command line.

use std::path::PathBuf;

use argil::mesh::Unit;
use argil::{Infill, WallOrder};
use clap::{Parser, Subcommand, ValueEnum};
use clap_complete::Shell;

use crate::machine::Job;
use crate::machine_args::MachineArgs;
use crate::shrinkage::Shrinkage;

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
    Plan(Box<PlanArgs>),
    /// Measure a g-code file of any slicer against its model, by geometry alone.
    ///
    /// What is not given of the bead is what the file states of it, if `argil plan` wrote it; else the defaults hold.
    #[command(after_help = EXIT_STATUS)]
    Audit(Box<AuditArgs>),
    /// Write test prints that measure a paste, and the page that tells how to read them.
    #[command(after_help = CALIBRATE_EXAMPLES)]
    Calibrate(Box<CalibrateArgs>),
    /// List the bundled models; plan one with `argil plan sample:NAME`.
    Samples,
    /// List the printers that argil knows, or show one with the source of every value.
    Printers {
        /// The printer to be shown: a name of the list, or a TOML file.
        #[arg(value_name = "NAME|FILE")]
        name: Option<String>,
    },
    /// List the pastes that argil knows, or show one with the source of every value.
    Materials {
        /// The paste to be shown: a name of the list, or a TOML file.
        #[arg(value_name = "NAME|FILE")]
        name: Option<String>,
    },
    /// Write a script that completes commands in a shell.
    #[command(after_help = COMPLETIONS)]
    Completions {
        /// The shell.
        shell: Shell,
    },
    /// Write the manual page.
    #[command(after_help = "Example: argil man > argil.1 && man ./argil.1")]
    Man,
}

const COMPLETIONS: &str = "Examples:
  argil completions bash > ~/.local/share/bash-completion/completions/argil
  argil completions fish > ~/.config/fish/completions/argil.fish";

const PLAN_EXAMPLES: &str = "Examples:
  argil plan vase.stl -o vase.gcode
  argil plan vase.stl -o vase.gcode --width 3 --layer-height 1 --height 120 --place center
  argil plan vase.stl -o vase.gcode --printer eazao-zero --material stoneware
  argil plan sample:cup -o cup.gcode --preview cup.html
  argil plan sample:cup -o cup.gcode --spiral --skirt
  argil plan sample:cup -o cup.gcode --cleaning cup-cleaning.html
  argil plan sample:cup -o cup.gcode --svg layers --report cup.json

Exit status: 0 done, 2 wrong usage, 3 bad input, 4 a plan with findings.";

const CALIBRATE_EXAMPLES: &str = "Examples:
  argil calibrate tests --width 3
  argil calibrate tests --printer eazao-zero --material stoneware --width 3 --layer-height 1

Print fan, windows and ring, and read them by legend.svg: it has the line that each reading gives for a file of your own.";

/// What a model is printed with.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct BeadArgs {
    /// A printer: a name that `argil printers` lists, or a TOML file. It gives the bead, the place on the bed, speeds,
    /// flow and machine code, unless options say otherwise.
    #[arg(long, value_name = "NAME|FILE")]
    pub(crate) printer: Option<String>,
    /// A paste: a name that `argil materials` lists, or a TOML file. It gives what the paste bears.
    #[arg(long, value_name = "NAME|FILE")]
    pub(crate) material: Option<String>,
    /// Bead width in mm [default: the printer's, the material's, or 1.5].
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    pub(crate) width: Option<f64>,
    /// Layer height in mm [default: with the width, or a third of it].
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    pub(crate) layer_height: Option<f64>,
    /// Walls side by side along every outline [default: 1].
    #[arg(long, value_name = "N")]
    pub(crate) walls: Option<usize>,
    /// The model is a sheet without thickness, as for spiral vases: its surface is the path of the wall itself.
    #[arg(long)]
    pub(crate) surface: bool,
    /// How far a bead may lie beside the one below, in bead widths [default: the material's, or 0.3].
    #[arg(long, value_name = "RATIO", allow_negative_numbers = true)]
    pub(crate) across: Option<f64>,
    /// The longest bridge along the strand, in bead widths [default: the material's, or 1.6].
    #[arg(long, value_name = "RATIO", allow_negative_numbers = true)]
    pub(crate) along: Option<f64>,
}

/// Where a model stands and how large it is.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct PlaceArgs {
    /// Keep the model's X and Y, centre it on the origin, or centre it on the printer's bed. It always stands on z = 0
    /// [default: bed where a printer is given whose bed is known, or keep].
    #[arg(long, value_enum)]
    pub(crate) place: Option<Place>,
    /// The unit of the model's file, where its format has none (STL, OBJ, PLY), or in place of the one that it states (3MF)
    /// [default: mm, or what the file states].
    #[arg(long, value_enum)]
    pub(crate) unit: Option<UnitArg>,
    /// Memory in GiB that slicing may take: larger models are refused before the work begins.
    #[arg(long, value_name = "GIB", default_value_t = 4.0)]
    pub(crate) memory: f64,
    /// Scale the model by this factor.
    #[arg(long, value_name = "F", conflicts_with = "height", allow_negative_numbers = true)]
    pub(crate) scale: Option<f64>,
    /// Scale the model to this height in mm.
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    pub(crate) height: Option<f64>,
    /// What the clay shrinks by from wet to fired, in per cent: the model is enlarged, so that the fired piece has its size. One
    /// number, or one for each axis.
    #[arg(long, value_name = "PERCENT[,Y,Z]", allow_hyphen_values = true)]
    pub(crate) shrinkage: Option<Shrinkage>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Place {
    /// Keep the model's own X and Y.
    Keep,
    /// Put the middle of the model on the origin.
    Center,
    /// Put the middle of the model on the middle of the printer's bed.
    Bed,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Pattern {
    /// Rings one inside the other, each joined to the next.
    Rings,
    /// Double spirals where rings do not branch: they turn back at their ends alone.
    Spirals,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum OrderArg {
    /// As the shortest steps from layer to layer have it.
    Any,
    /// The outermost first.
    OuterFirst,
    /// The outermost last.
    OuterLast,
}

impl From<OrderArg> for WallOrder {
    fn from(order: OrderArg) -> Self {
        match order {
            OrderArg::Any => Self::Any,
            OrderArg::OuterFirst => Self::OuterFirst,
            OrderArg::OuterLast => Self::OuterLast,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum UnitArg {
    /// 0.001 mm.
    Micron,
    /// Millimetres.
    Mm,
    /// 10 mm.
    Cm,
    /// 25.4 mm.
    Inch,
    /// 304.8 mm.
    Foot,
    /// 1,000 mm.
    M,
}

impl From<UnitArg> for Unit {
    fn from(unit: UnitArg) -> Self {
        match unit {
            UnitArg::Micron => Self::Micron,
            UnitArg::Mm => Self::Millimetre,
            UnitArg::Cm => Self::Centimetre,
            UnitArg::Inch => Self::Inch,
            UnitArg::Foot => Self::Foot,
            UnitArg::M => Self::Metre,
        }
    }
}

#[derive(Debug, clap::Args)]
pub(crate) struct PlanArgs {
    /// The model: an STL, OBJ, PLY or 3MF file, layers in SVG or JSON, or sample:NAME.
    #[arg(value_name = "MODEL")]
    pub(crate) model: String,
    /// Where the g-code goes; for a robot cell, the table of poses.
    #[arg(short, long, value_name = "OUT.gcode")]
    pub(crate) output: PathBuf,
    /// Take options from a TOML file: `width = 3` stands for `--width 3`. Options on the command line come first.
    #[arg(long, value_name = "FILE.toml")]
    pub(crate) config: Option<PathBuf>,
    /// Write the options as such a file to standard output, and do nothing else.
    #[arg(long)]
    pub(crate) print_config: bool,
    /// Say nothing but warnings and errors.
    #[arg(short, long)]
    pub(crate) quiet: bool,
    /// Write what is known about the plan as JSON; `-` is standard output.
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
    /// Write a page that says where to cut after printing, from the top down, with pictures.
    #[arg(long, value_name = "OUT.html", conflicts_with = "no_audit")]
    pub(crate) cleaning: Option<PathBuf>,
    /// Write an overview picture.
    #[arg(long, value_name = "OUT.png")]
    pub(crate) png: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) bead: BeadArgs,
    /// Which of several walls is laid first, as far as a start allows that a short step leads to.
    #[arg(long, value_enum, default_value_t = OrderArg::Any)]
    pub(crate) wall_order: OrderArg,
    /// Fill the N lowest layers whole.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) floor: usize,
    /// Close every face that looks up or down and is wider than a bead, with N layers.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) skin: usize,
    /// Let the layers rise evenly along their cycles wherever they can, so that no step is left between them.
    #[arg(long)]
    pub(crate) spiral: bool,
    /// Go round the part on the bed first, in the same strand; `--skirt=3` goes round three times, `--skirt` twice.
    #[arg(long, value_name = "N", num_args = 0..=1, require_equals = true, default_missing_value = "2")]
    pub(crate) skirt: Option<usize>,
    /// From the part to the skirt, middle of bead to middle of bead, in bead widths.
    #[arg(long, value_name = "RATIO", default_value_t = 3.0, allow_negative_numbers = true)]
    pub(crate) skirt_distance: f64,
    /// How floors and skins are filled.
    #[arg(long, value_enum, default_value_t = Pattern::Rings)]
    pub(crate) fill_pattern: Pattern,
    /// Lay all fill with the same flow. If not, its beads are as wide as there is room between their neighbours, from 0.75 to 1.33 of the width.
    #[arg(long)]
    pub(crate) even_flow: bool,
    /// Fill the inside of the walls sparsely, with this share of clay; `auto`: only below what `--skin` fills, as dense and as far down as
    /// that needs, and only if the strand gets shorter than with support from the walls.
    #[arg(long, value_name = "RATIO|auto", value_parser = infill, allow_negative_numbers = true)]
    pub(crate) infill: Option<Infill>,
    #[command(flatten)]
    pub(crate) place: PlaceArgs,
    #[command(flatten)]
    pub(crate) machine: MachineArgs,
    /// Write a table of poses for robot cells as well.
    #[arg(long, value_name = "OUT.csv")]
    pub(crate) poses: Option<PathBuf>,
    /// Write a plan also where it reaches beyond the printer's volume.
    #[arg(long)]
    pub(crate) beyond_volume: bool,
    /// Write what was planned after all repairs: the outline of each layer as a prism, as STL. Measure other prints of the same file
    /// against it, or look at what became of it.
    #[arg(long, value_name = "OUT.stl")]
    pub(crate) repaired: Option<PathBuf>,
    /// Refuse a model that has to be repaired, and tell what is wrong with it and where.
    #[arg(long)]
    pub(crate) strict: bool,
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
pub(crate) struct CalibrateArgs {
    /// The folder that the test prints and their legend go to.
    #[arg(value_name = "DIR")]
    pub(crate) folder: PathBuf,
    /// A printer: a name that `argil printers` lists, or a TOML file.
    #[arg(long, value_name = "NAME|FILE")]
    pub(crate) printer: Option<String>,
    /// A paste to begin with: a name that `argil materials` lists, or a TOML file. It gives bead and speed where the
    /// printer does not.
    #[arg(long, value_name = "NAME|FILE")]
    pub(crate) material: Option<String>,
    /// Bead width in mm [default: the printer's, the material's, or 1.5].
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    pub(crate) width: Option<f64>,
    /// Layer height in mm [default: with the width, or a third of it].
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    pub(crate) layer_height: Option<f64>,
    #[command(flatten)]
    pub(crate) machine: MachineArgs,
}

#[derive(Debug, clap::Args)]
pub(crate) struct AuditArgs {
    /// The g-code file.
    #[arg(value_name = "OUT.gcode")]
    pub(crate) gcode: PathBuf,
    /// The model that it was made from: an STL, OBJ, PLY or 3MF file, or sample:NAME.
    #[arg(long, value_name = "MODEL")]
    pub(crate) model: String,
    /// Bead width that the tolerances of the audit are meant for, in mm [default: the bead's width].
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    pub(crate) tolerance_width: Option<f64>,
    /// Write the figures as JSON; `-` is standard output, in place of the text.
    #[arg(long, value_name = "OUT.json")]
    pub(crate) json: Option<PathBuf>,
    /// How many of the lowest layers are to be closed: what of them lies open is measured.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) floor: usize,
    /// Whether faces that look up or down are to be closed: what of them lies open is measured.
    #[arg(long)]
    pub(crate) skin: bool,
    #[command(flatten)]
    pub(crate) bead: BeadArgs,
    #[command(flatten)]
    pub(crate) place: PlaceArgs,
}

/// `auto`, or a number.
fn infill(text: &str) -> Result<Infill, String> {
    match text {
        "auto" => Ok(Infill::Auto),
        _ => text.parse().map(Infill::Ratio).map_err(|_| "must be `auto` or a number".to_owned()),
    }
}

impl PlanArgs {
    /// What is written for the machine.
    pub(crate) fn job(&self) -> Job<'_> {
        Job { model: &self.model, bead: &self.bead, machine: &self.machine }
    }
}

impl CalibrateArgs {
    /// The bead of the test prints, as plans take it.
    pub(crate) fn bead(&self) -> BeadArgs {
        BeadArgs {
            printer: self.printer.clone(),
            material: self.material.clone(),
            width: self.width,
            layer_height: self.layer_height,
            walls: None,
            surface: false,
            across: None,
            along: None,
        }
    }
}
