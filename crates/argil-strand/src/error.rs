//! Why there is no strand.

/// Why layers do not make a strand.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StrandError {
    /// There is no layer, so nothing is laid.
    #[error("a strand needs at least one layer")]
    NoLayers,
    /// A number is infinite or not a number.
    #[error("layer {layer}: {what} is not finite")]
    NotFinite {
        /// Position of the layer, counted from the lowest.
        layer: usize,
        /// Which number it is.
        what: &'static str,
    },
    /// A bead without a positive height and width.
    #[error("layer {layer}: a bead of {width} mm by {height} mm cannot be laid")]
    NoBead {
        /// Position of the layer, counted from the lowest.
        layer: usize,
        /// Width of the bead, mm.
        width: f64,
        /// Height of the bead, mm.
        height: f64,
    },
    /// A layer lies no higher than the one below.
    #[error("layer {layer}: z = {z} mm is not above the layer below at {below} mm")]
    NotRising {
        /// Position of the layer, counted from the lowest.
        layer: usize,
        /// Its z, mm.
        z: f64,
        /// The z of the layer below, mm.
        below: f64,
    },
    /// A layer's number is not higher than that of the one below.
    #[error("layer {layer}: number {index} is not above {below}, the number of the layer below")]
    NumberNotRising {
        /// Position of the layer, counted from the lowest.
        layer: usize,
        /// Its number.
        index: usize,
        /// The number of the layer below.
        below: usize,
    },
    /// A layer above the lowest does not begin with a seam step.
    #[error("layer {layer}: the first move is not the seam step from the layer below")]
    NoSeamStep {
        /// Position of the layer, counted from the lowest.
        layer: usize,
    },
    /// A layer has no move besides its seam step.
    #[error("layer {layer}: nothing is laid on it")]
    NoMoves {
        /// Position of the layer, counted from the lowest.
        layer: usize,
    },
    /// A layer does not end where it began.
    #[error("layer {layer}: the cycle is open by {gap} mm")]
    Open {
        /// Position of the layer, counted from the lowest.
        layer: usize,
        /// Distance from its last point to its first, mm.
        gap: f64,
    },
    /// Skirt is laid elsewhere than before the lowest layer's cycle.
    #[error("layer {layer}: skirt is laid before the lowest layer's cycle and nowhere else")]
    Skirt {
        /// Position of the layer, counted from the lowest.
        layer: usize,
    },
    /// The rises given are not one for each layer, or of a layer not one for each move; or the lowest layer, which lies on the bed,
    /// is to rise.
    #[error("layer {layer}: {given} rises are given where {wanted} are due")]
    RiseCount {
        /// Position of the layer, counted from the lowest.
        layer: usize,
        /// How many there are.
        given: usize,
        /// How many there should be; 0 for a layer that lies level.
        wanted: usize,
    },
    /// The widths given are not one for each layer, or of a layer not one for each move.
    #[error("layer {layer}: {given} widths are given where {wanted} are due")]
    WidthCount {
        /// Position of the layer, counted from the lowest.
        layer: usize,
        /// How many there are.
        given: usize,
        /// How many there should be.
        wanted: usize,
    },
    /// The strand falls.
    #[error("layer {layer}: the strand falls from {from} mm to {to} mm")]
    Falling {
        /// Position of the layer, counted from the lowest.
        layer: usize,
        /// The z before, mm.
        from: f64,
        /// The z after, mm.
        to: f64,
    },
}
