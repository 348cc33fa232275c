//! Options about the machine: what the g-code looks like.

use std::path::PathBuf;

use clap::ValueEnum;

/// How the strand is written. Without a printer the defaults are those of `argil-gcode`.
#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = "Machine")]
pub(crate) struct MachineArgs {
    /// Paste in mm³ that one unit of E pushes out [default: the printer's, or 2.405, filament of 1.75 mm].
    #[arg(long, value_name = "MM3", conflicts_with_all = ["volumetric", "constant_rate"])]
    pub(crate) mm3_per_e: Option<f64>,
    /// E in mm³ (M200), with the filament diameter that the firmware is to reckon with.
    #[arg(long, value_name = "MM", conflicts_with = "constant_rate")]
    pub(crate) volumetric: Option<f64>,
    /// No E at all: paste comes at this constant rate in mm³/s, and speed alone keeps the bead at its width.
    #[arg(long, value_name = "MM3/S")]
    pub(crate) constant_rate: Option<f64>,
    /// Whether E counts up, or each E is that of its own move [default: the printer's, or relative].
    #[arg(long, value_enum)]
    pub(crate) e: Option<EMode>,
    /// The firmware [default: the printer's, or marlin].
    #[arg(long, value_enum)]
    pub(crate) flavour: Option<FlavourArg>,
    /// Speed in mm/s [default: the printer's, the material's, or 25].
    #[arg(long, value_name = "MM/S")]
    pub(crate) feed: Option<f64>,
    /// Speed on the lowest layer in mm/s [default: the printer's, or 15].
    #[arg(long, value_name = "MM/S")]
    pub(crate) first_layer_feed: Option<f64>,
    /// Speed before and after the strand in mm/s [default: the printer's, or 25].
    #[arg(long, value_name = "MM/S")]
    pub(crate) travel_feed: Option<f64>,
    /// The viewer whose words name the roles.
    #[arg(long, value_enum, default_value_t = Viewer::PrusaSlicer)]
    pub(crate) viewer: Viewer,
    /// Put a picture of this many pixels into the header, as Klipper's pages and OctoPrint show it.
    #[arg(long, value_name = "PIXELS", value_parser = clap::value_parser!(u32).range(16..=1024))]
    pub(crate) thumbnail: Option<u32>,
    /// Write arcs (G2, G3) that are nowhere farther from the plan than this, in mm.
    #[arg(long, value_name = "MM")]
    pub(crate) arcs: Option<f64>,
    /// After the strand, go on along its uppermost cycle without paste for so far, in mm, before the nozzle leaves.
    #[arg(long, value_name = "MM", default_value_t = 0.0, allow_negative_numbers = true)]
    pub(crate) wipe: f64,
    /// Give every line a number and a checksum.
    #[arg(long)]
    pub(crate) line_numbers: bool,
    /// Code before the strand, from a file with names in braces [default: the printer's].
    #[arg(long, value_name = "FILE")]
    pub(crate) start: Option<PathBuf>,
    /// Code after the strand, from a file with names in braces [default: the printer's].
    #[arg(long, value_name = "FILE")]
    pub(crate) end: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum EMode {
    /// Each E is the amount of its own move (M83).
    Relative,
    /// E counts up through each layer (M82).
    Absolute,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum FlavourArg {
    /// Marlin.
    Marlin,
    /// `RepRapFirmware`.
    #[value(name = "reprapfirmware")]
    RepRapFirmware,
    /// Klipper.
    Klipper,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Viewer {
    /// PrusaSlicer: draws beads of clay at their width.
    #[value(name = "prusaslicer")]
    PrusaSlicer,
    /// OrcaSlicer.
    #[value(name = "orcaslicer")]
    OrcaSlicer,
    /// Cura: draws beads wider than 1.2 mm as threads of 0.35 mm.
    Cura,
}
