//! Beads that do not lie level.

/// How high a stretch of bead lies whose layer does not lie level.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Rise {
    /// Height of the top of the bead above the bed where the stretch ends, mm. Between its ends it rises evenly.
    pub z: f64,
    /// Height of the bead itself, mm: from what lies below it to its top, in the mean over the stretch. It is 0 where the bead
    /// below lies as high already.
    pub height: f64,
}
