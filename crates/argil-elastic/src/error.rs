//! What can be wrong with a path or with the options.

use thiserror::Error;

/// Why a path could not be relaxed.
///
/// Every variant is found before the first step, so a path that is accepted always yields a result.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ElasticError {
    /// A list that runs parallel to the points has another length than the points.
    #[error("`{list}` has {found} entries, the path has {expected} points")]
    LengthMismatch {
        /// Which field of [`Path`](crate::Path) it is.
        list: &'static str,
        /// Its length.
        found: usize,
        /// The number of points.
        expected: usize,
    },
    /// A point of the path is not a finite number.
    #[error("point {vertex} of the path is not finite")]
    PointNotFinite {
        /// Index into [`Path::points`](crate::Path::points).
        vertex: usize,
    },
    /// A carrier names a vertex that the path does not have, or its anchor is not finite.
    #[error("carrier {carrier} (vertex {vertex}) has no such vertex or no finite anchor")]
    BadCarrier {
        /// Index into [`Path::carriers`](crate::Path::carriers).
        carrier: usize,
        /// The vertex it names.
        vertex: usize,
    },
    /// A carrier starts outside its envelope, where Eq. 6 has no value.
    ///
    /// Nothing is repaired here: only the caller knows whether the vertex or the anchor is wrong.
    #[error(
        "carrier {carrier} (vertex {vertex}) starts {distance} mm from its anchor, envelope {envelope} mm"
    )]
    CarrierOutside {
        /// Index into [`Path::carriers`](crate::Path::carriers).
        carrier: usize,
        /// The vertex it names.
        vertex: usize,
        /// Distance from the vertex to the anchor, mm.
        distance: f64,
        /// The envelope of the options, mm.
        envelope: f64,
    },
    /// An option has a value for which no energy is defined.
    #[error("option `{option}` is {value}, it must be {expected}")]
    BadOption {
        /// The field of the options.
        option: &'static str,
        /// Its value.
        value: f64,
        /// What would be accepted.
        expected: &'static str,
    },
}
