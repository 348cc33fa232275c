#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod arc;
mod arc_fit;
mod dialect;
mod error;
mod number;
mod pen;
mod poses;
mod program;
mod reader;
mod settings;
mod words;
mod writer;

pub use argil_strand as strand;
pub use dialect::{Extrusion, Flavour};
pub use error::GcodeError;
pub use poses::Poses;
pub use program::{BadLine, Fault, Move, Program};
pub use reader::{ARC_TOLERANCE, read_gcode};
pub use settings::{FILAMENT_1_75, GcodeSettings, RoleNames};
pub use writer::{Gcode, write_gcode};
