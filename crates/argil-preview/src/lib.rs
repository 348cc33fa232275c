#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod colour;
mod layer;
mod markup;
mod overview;
mod projection;
#[cfg(feature = "png")]
mod raster;
mod simplify;

pub use colour::{Colour, Palette};
pub use layer::{SvgStyle, layer_svg};
pub use overview::{ViewStyle, overview_svg};
#[cfg(feature = "png")]
pub use raster::{PreviewError, png};
