//! What a plan consists of.

use std::time::Duration;

use argil_slice::Loss;
use argil_strand::Strand;

/// A finished plan: one strand, and what is known about it.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Plan {
    /// The whole print as one polyline.
    pub strand: Strand,
    /// One entry a layer of the strand, bottom first.
    pub layers: Vec<LayerReport>,
    /// What of the model is not, or not quite, printed: too thin, or broken in the mesh.
    pub losses: Vec<Loss>,
    /// Where the time went. The only part of a plan that differs from run to run.
    pub times: StageTimes,
}

/// What happened in a layer.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct LayerReport {
    /// Index of the layer in the slicing, 0 at the bottom.
    pub index: usize,
    /// Walls in it.
    pub walls: usize,
    /// Points of the layer above that it was asked to hold.
    pub supports: usize,
    /// Places where the strand leaves a wall.
    pub roots: usize,
    /// Length of walls, mm.
    pub wall_length: f64,
    /// Length of fill, mm: floors, roofs and undersides.
    #[cfg_attr(feature = "serde", serde(default))]
    pub fill_length: f64,
    /// Diameter of the widest disc in a filled zone that stays bare, mm; 0 where none is wider than a third of a bead.
    #[cfg_attr(feature = "serde", serde(default))]
    pub widest_bare: f64,
    /// Length of everything else, mm.
    pub free_length: f64,
    /// Vertices that were pulled back after smoothing, so that the layer above stays held.
    pub pulled_back: usize,
}

/// Time spent in each stage.
///
/// # Example
/// ```
/// use std::time::Duration;
/// use argil::StageTimes;
/// let times = StageTimes { slice: Duration::from_millis(20), route: Duration::from_millis(30), ..StageTimes::default() };
/// assert_eq!(times.total(), Duration::from_millis(50));
/// assert_eq!(times.listed()[0], ("slice", Duration::from_millis(20)));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct StageTimes {
    /// Cutting the mesh and insetting walls.
    pub slice: Duration,
    /// Zones that are filled, and their fill.
    pub fill: Duration,
    /// The safeguard.
    pub safeguard: Duration,
    /// Detecting and placing support.
    pub support: Duration,
    /// Regions, graphs, tours, circuit.
    pub route: Duration,
    /// The elastic curve.
    pub smooth: Duration,
    /// Taking out the slack.
    pub taut: Duration,
    /// Checks, repairs and blunting.
    pub check: Duration,
    /// The chain of starts and the strand.
    pub seam: Duration,
}

impl StageTimes {
    /// Names and durations in the order of the stages.
    #[must_use]
    pub fn listed(&self) -> [(&'static str, Duration); 9] {
        [
            ("slice", self.slice),
            ("fill", self.fill),
            ("safeguard", self.safeguard),
            ("support", self.support),
            ("route", self.route),
            ("smooth", self.smooth),
            ("taut", self.taut),
            ("check", self.check),
            ("seam", self.seam),
        ]
    }

    /// All of it.
    #[must_use]
    pub fn total(&self) -> Duration {
        self.listed().iter().map(|(_, time)| *time).sum()
    }
}
