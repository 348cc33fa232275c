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
    /// The skirt as it was laid; `None` where none was asked for, or where there is no room for one or no way from it to the part.
    pub skirt: Option<SkirtLaid>,
    /// What [`Infill::Auto`](crate::Infill::Auto) has chosen; `None` for other plans.
    pub infill: Option<InfillChoice>,
    /// Where the time went. The only part of a plan that differs from run to run.
    pub times: StageTimes,
}

/// The skirt of a plan.
///
/// # Example
/// ```
/// use argil::{Bed, Planner, Settings, Skirt, SkirtLaid, mesh::Mesh};
/// // Five turns are asked for; a bed of 40 mm has room for fewer.
/// let bed = Bed::Rectangle { low: [-20.0; 2], high: [20.0; 2] };
/// let skirt = Skirt { turns: 5, bed: Some(bed), ..Skirt::default() };
/// let settings = Settings { skirt: Some(skirt), ..Settings::for_width(2.0) };
/// let plan = Planner::default().plan(&Mesh::cuboid([-13.0, -13.0, 0.0], [13.0, 13.0, 2.0])?, &settings)?;
/// let laid: SkirtLaid = plan.skirt.ok_or("there is room for one")?;
/// assert!((1..5).contains(&laid.turns) && laid.length > 4.0 * 26.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SkirtLaid {
    /// Turns round the part: as many as were asked for, or as many as the bed has room for.
    pub turns: usize,
    /// From the lowest layer's strand to the innermost turn, middle to middle, mm: as asked for, or as the bed has room for.
    pub distance: f64,
    /// Length, mm, with the way to the part.
    pub length: f64,
}

/// Which of two plans was taken: the shorter strand.
///
/// # Example
/// ```
/// use argil::{Infill, InfillChoice, Planner, Settings, mesh::Mesh};
/// // A closed box: its roof lies over nothing.
/// let settings = Settings { skin: 1, infill: Infill::Auto, ..Settings::for_width(2.0) };
/// let plan = Planner::default().plan(&Mesh::cuboid([0.0; 3], [16.0, 16.0, 6.0])?, &settings)?;
/// let InfillChoice { taken, with_mm, without_mm } = plan.infill.ok_or("there is a choice")?;
/// let [with, without] = [with_mm, without_mm].map(|length| length.unwrap_or(f64::INFINITY));
/// assert_eq!(taken, with < without);
/// assert!((plan.strand.length() - with.min(without)).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct InfillChoice {
    /// Whether it is the one with infill.
    pub taken: bool,
    /// Length of the strand with infill, mm; `None` where there is no such plan.
    pub with_mm: Option<f64>,
    /// Length of the strand that holds the same with support from the walls, mm; `None` where there is no such plan.
    pub without_mm: Option<f64>,
}

/// What happened in a layer.
///
/// # Example
/// ```
/// use argil::{Climb, LayerReport, LevelCause, Plan, Planner, Settings, mesh::Mesh};
/// let settings = Settings { spiral: true, ..Settings::for_width(2.0) };
/// let plan: Plan = Planner::default().plan(&Mesh::cuboid([0.0; 3], [20.0, 20.0, 8.0])?, &settings)?;
/// let [bed, rim]: [&LayerReport; 2] = [&plan.layers[0], &plan.layers[plan.layers.len() - 1]];
/// assert_eq!((bed.walls, bed.supports, bed.level_because), (1, 0, Some(LevelCause::Bed)));
/// assert!(rim.climb == Climb::Levelling && plan.layers[5].level_because.is_none());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
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
    /// Length of fill, mm: floors, roofs, undersides and infill.
    #[cfg_attr(feature = "serde", serde(default))]
    pub fill_length: f64,
    /// Of it, infill.
    #[cfg_attr(feature = "serde", serde(default))]
    pub infill_length: f64,
    /// Diameter of the widest disc in a filled zone that stays bare, mm; 0 where none is wider than a third of a bead.
    #[cfg_attr(feature = "serde", serde(default))]
    pub widest_bare: f64,
    /// Length of everything else, mm.
    pub free_length: f64,
    /// Vertices that were pulled back after smoothing, so that the layer above stays held.
    pub pulled_back: usize,
    /// How the strand comes up to it.
    #[cfg_attr(feature = "serde", serde(default))]
    pub climb: Climb,
    /// Why it does not rise, where a spiral was asked for.
    #[cfg_attr(feature = "serde", serde(default))]
    pub level_because: Option<LevelCause>,
    /// The share of the step up to it that a ramp takes.
    #[cfg_attr(feature = "serde", serde(default))]
    pub ramp: f64,
    /// How much of the outer walls is laid ahead of the others, where an order is asked for and there are others: of all pairs of a piece of an
    /// outer wall and a piece of another the share in which the outer one comes first.
    #[cfg_attr(feature = "serde", serde(default))]
    pub outer_ahead: Option<f64>,
    /// The thinnest and the thickest bead, mm, apart from where it begins and ends.
    #[cfg_attr(feature = "serde", serde(default))]
    pub bead_heights: [f64; 2],
}

/// How the strand comes up to a layer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Climb {
    /// By a short step at its beginning; then it lies level.
    #[default]
    Step,
    /// Along a ramp at its beginning; then it lies level.
    Ramp,
    /// Along its whole cycle, from the end of the layer below.
    Rising,
    /// Not at all: it lies level on a layer that rose, and its bead grows thinner until it is nothing.
    Levelling,
}

/// Why a layer of a spiral does not rise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
#[non_exhaustive]
pub enum LevelCause {
    /// It lies on the bed.
    Bed,
    /// It is the rim, which is level.
    Rim,
    /// Its cycle passes the places of the one below in another order, or goes a much longer way between them: beads would be too
    /// thick or too thin.
    Order,
    /// Its cycle is so short that it would rise too steeply.
    Short,
    /// There are too few layers between level ones to share their rise.
    Few,
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
