#![doc = include_str!("../README.md")]
//!
//! # In a picture
//!
#![doc = include_str!("../pictures/safeguard.svg")]
//!
//! A plate with a tower on it, seen from above: the envelope is widest at the plate and closes in on the tower from layer to layer.
//!
//! # Where it comes from
//! Sec. 3.4 of *Continuous deposition*: `S_0` is the first layer's outer walls dilated, and each further `S_i` is
//! `S_{i−1}` shrunk by `ε_across`, united with its own dilated walls. The paper never says by how much the
//! walls are dilated; [`SafeguardSettings::for_width`] takes one bead width, so that a
//! strand along the edge of the safeguard just clears the wall's bead.
//!
//! Lengths are millimetres. Regions are `geo-types` multipolygons with exteriors counter-clockwise.
#![forbid(unsafe_code)]

mod envelope;
mod settings;

pub use envelope::{safeguards, safeguards_while};
pub use settings::SafeguardSettings;
