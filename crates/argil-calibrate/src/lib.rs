#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod calibration;
mod error;
mod fan;
mod layers;
mod legend;
mod ring;
mod sheet;
mod windows;

pub use argil_strand::{BeadShape, DVec2, Strand};
pub use calibration::Calibration;
pub use error::CalibrateError;
pub use fan::LEANS;
pub use legend::legend_svg;
pub use windows::GAPS;
