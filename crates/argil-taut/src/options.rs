//! How far paths are pulled.

/// Limits of the pull. Lengths in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct TautOptions {
    /// Bead width w.
    pub width: f64,
    /// `ε_across`: how far a strand may lie beside what holds it.
    pub across: f64,
    /// `ε_along`: the longest stretch that may hang.
    pub along: f64,
    /// Share of both that is used; the rest is left to rounding.
    pub used: f64,
    /// How often every point is looked at, at most. Points whose surroundings have come to rest are passed over.
    pub sweeps: usize,
    /// Strands come no nearer to each other and to walls than this, unless they were nearer before, in w.
    pub apart: f64,
    /// What they keep from walls, in w.
    pub off: f64,
    /// Within this way of the place where a strand leaves its wall it may come nearer to it, in w.
    pub root: f64,
}

impl TautOptions {
    /// The options that serve clay at a bead width.
    #[must_use]
    pub fn for_width(width: f64) -> Self {
        Self {
            width,
            across: 0.3 * width,
            along: 1.6 * width,
            used: 0.985,
            sweeps: 30,
            apart: 1.0,
            off: 1.0,
            root: 4.0 / 3.0,
        }
    }

    /// Whether every value can be worked with.
    pub(crate) fn is_usable(&self) -> bool {
        let positive = [self.width, self.across, self.along, self.used];
        let rest = [self.apart, self.root];
        positive.iter().all(|&x| x.is_finite() && x > 0.0) && rest.iter().all(|&x| x.is_finite() && x >= 0.0)
    }
}

impl Default for TautOptions {
    /// Clay at a bead width of 1.5 mm, as in the paper.
    fn default() -> Self {
        Self::for_width(1.5)
    }
}
