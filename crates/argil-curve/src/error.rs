//! Why a list of points is no closed curve.

/// What makes a list of points unfit to be a [`ClosedCurve`](crate::ClosedCurve).
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CurveError {
    /// A coordinate is infinite or not a number.
    #[error("vertex {vertex} has a coordinate that is not finite")]
    NotFinite {
        /// Index of the vertex in the list as it was given.
        vertex: usize,
    },
    /// A closed curve needs two points that differ; a single point has no length and no direction.
    #[error("a closed curve needs at least 2 distinct points, not {distinct}")]
    TooFewPoints {
        /// Points left once consecutive equal ones are counted once.
        distinct: usize,
    },
    /// The coordinates are so large that the length of the curve is not a finite number.
    #[error("the length of the curve is not finite")]
    TooLong,
}
