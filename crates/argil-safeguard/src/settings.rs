/// How wide the safeguard is and how fast it may shrink on its way up.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct SafeguardSettings {
    /// How far the outer walls are dilated, in millimetres: one bead width by default (the paper
    /// does not say). More keeps support farther from the surface and makes it longer.
    pub dilation: f64,
    /// What the envelope of the layer below shrinks by, in millimetres: `ε_across`, 0.3 w by
    /// default (Sec. 3.4). It must not be more than a strand can lean by from layer to layer, or support that
    /// clears the safeguard above cannot clear it below.
    pub shrink: f64,
}

impl SafeguardSettings {
    /// The settings of the clay in the paper, for a bead of this width in millimetres.
    #[must_use]
    pub fn for_width(width: f64) -> Self {
        Self { dilation: width, shrink: 0.3 * width }
    }

    /// How much larger than the exact region each one may be, in millimetres.
    ///
    /// It grows by this in every step before it is simplified, so it must be a small part of the
    /// shrinking: a tenth, 0.03 w, leaves some twenty vertices on a full turn.
    pub(crate) fn tolerance(&self) -> f64 {
        0.1 * self.shrink
    }
}

impl Default for SafeguardSettings {
    /// For a bead of 1.5 mm.
    fn default() -> Self {
        Self::for_width(1.5)
    }
}
