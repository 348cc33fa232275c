#![doc = include_str!("../README.md")]
//!
//! # How it is built
//! [`json`] is a form of our own. [`svg`] walks the tree of a drawing: the page tells the unit and where the lower left corner is,
//! groups are layers, and each shape becomes closed contours, its curves as chords. Nothing here opens a file or prints.
//!
//! Lengths are millimetres, x is to the right and y away from the reader, as a layer is seen from above.
#![forbid(unsafe_code)]

mod error;
mod json;
mod layers;
#[cfg(feature = "svg")]
mod svg;

pub use error::LayersError;
pub use json::{is_json, json};
pub use layers::Layers;
#[cfg(feature = "svg")]
pub use svg::{SvgSettings, is_svg, svg};
