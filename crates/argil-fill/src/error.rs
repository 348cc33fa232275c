//! Why there is no fill.

/// What keeps a region from being filled.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FillError {
    /// An option is not finite, or out of its range.
    #[error("fill option `{name}` cannot be {value}: it must be {expected}")]
    Option {
        /// Name of the field of [`FillOptions`](crate::FillOptions).
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it must be.
        expected: &'static str,
    },
    /// A coordinate of the region is not finite, or so large that the bead is lost in its rounding.
    #[error("the region has a coordinate of {value}: at most {limit} is possible with this bead")]
    Coordinate {
        /// The coordinate, mm.
        value: f64,
        /// The largest that is possible, mm.
        limit: f64,
    },
    /// A ring is no closed curve: it has fewer than three distinct points, or one that is not finite.
    #[error("ring {ring} is no closed curve")]
    Ring {
        /// Its index among the rings that were given.
        ring: usize,
    },
    /// A part of the region is so large, or so long and slanted, that the grid of points over it would not be held.
    #[error("the region needs a grid of {points} points: at most {limit} are held")]
    TooLarge {
        /// How many points it would have.
        points: f64,
        /// The limit.
        limit: f64,
    },
    /// The region is so large that its fill would have more than so many rings.
    #[error("the region needs more than {limit} rings")]
    TooManyRings {
        /// The limit.
        limit: usize,
    },
}
