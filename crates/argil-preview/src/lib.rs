#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod base64;
mod cleaning;
mod colour;
mod cut;
mod layer;
mod markup;
mod outline;
mod overview;
mod page;
mod projection;
#[cfg(feature = "png")]
mod raster;
mod simplify;
mod thumbnail;
mod widths;

pub use argil_strand as strand;
pub use cleaning::{CleaningStyle, CutPlace, cleaning_html};
pub use colour::{Colour, Palette};
pub use layer::{SvgStyle, layer_svg};
pub use overview::{ViewStyle, overview_svg};
pub use page::{PageMark, PageStyle, page_html};
#[cfg(feature = "png")]
pub use raster::{PreviewError, png};
pub use thumbnail::thumbnail;
