#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod arc;
mod error;
mod number;
mod program;
mod reader;
mod settings;
mod words;
mod writer;

pub use error::GcodeError;
pub use program::{BadLine, Fault, Move, Program};
pub use reader::{ARC_TOLERANCE, read_gcode};
pub use settings::{FILAMENT_1_75, GcodeSettings, RoleNames};
pub use writer::{Gcode, write_gcode};
