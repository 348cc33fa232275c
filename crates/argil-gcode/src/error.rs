//! What can keep a strand from becoming g-code.

use crate::Flavour;

/// Why no g-code was written.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GcodeError {
    /// A setting is outside of what makes sense for it.
    #[error("setting {name} = {value}: must be {must_be}")]
    Setting {
        /// Name of the field in [`GcodeSettings`](crate::GcodeSettings).
        name: &'static str,
        /// Its value.
        value: f64,
        /// What is accepted.
        must_be: &'static str,
    },
    /// The firmware lacks what a setting asks for.
    #[error("{flavour} has no {lacks}")]
    Dialect {
        /// The firmware.
        flavour: Flavour,
        /// What it lacks.
        lacks: &'static str,
    },
    /// A header key or a role name that viewers would take for something else.
    #[error("{text:?} cannot stand in a comment: {why}")]
    Comment {
        /// The text.
        text: String,
        /// What is wrong with it.
        why: &'static str,
    },
    /// A coordinate or an amount too large to be written with the decimals asked for.
    #[error("layer {layer}: {value} is too large to be written with {decimals} decimals")]
    OutOfRange {
        /// Position of the layer, counted from the lowest.
        layer: usize,
        /// The number, mm or units of E.
        value: f64,
        /// Decimals asked for.
        decimals: u8,
    },
    /// Two layers would be written at the same height.
    #[error("layer {layer}: z = {z} mm is the same as that of the layer below with {decimals} decimals")]
    LayersMerge {
        /// Position of the upper one, counted from the lowest.
        layer: usize,
        /// Its height, mm.
        z: f64,
        /// Decimals asked for.
        decimals: u8,
    },
}
