//! Why an audit could not be made.

use argil_slice::SliceError;

/// Why an audit could not be made. What is wrong with the print is no error: it is in the report.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AuditError {
    /// A setting is not a positive number (or, for the offset, not a number at all).
    #[error("the setting `{name}` cannot be {value}")]
    Setting {
        /// The field of the settings.
        name: &'static str,
        /// What it was.
        value: f64,
    },
    /// No move of the program lays clay.
    #[error("the g-code extrudes nothing")]
    NothingExtruded,
    /// The program has more to measure than fits in memory at this step: usually a coordinate is wrong.
    #[error("{length:.0} mm of path or outline cannot be sampled every {step} mm")]
    TooLong {
        /// Length that would be sampled, mm.
        length: f64,
        /// Distance between samples, mm.
        step: f64,
    },
    /// The mesh could not be cut into layers.
    #[error("the mesh could not be cut into layers")]
    Slice(#[from] SliceError),
}
