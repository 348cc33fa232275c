//! What cannot be printed for calibration.

use argil_strand::StrandError;

/// Why there is no test print.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CalibrateError {
    /// A setting outside of what can be printed.
    #[error("{name}: {value} must be {must_be}")]
    Setting {
        /// The setting.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it must be.
        must_be: &'static str,
    },
    /// The layers make no strand; numbers that are too coarse for their size do that.
    #[error(transparent)]
    Strand(#[from] StrandError),
}
