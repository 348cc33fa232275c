//! The cheapest chain of starts through all layers.

use crate::SeamError;
use crate::plan::Plan;
use argil_curve::{ClosedCurve, DVec2};

/// Rounds in which only layers that the cheapest chain enters by a crossing step are tested for crossings.
/// Few layers ever need it, and testing all takes as long as the plan itself; after this many rounds all are
/// tested.
const TRUSTING_ROUNDS: usize = 32;

/// The limits of a chain of starts. Lengths in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct SeamSettings {
    /// `ε_across` of the paste: a start lies no further than this from the cycle below. Smaller is safer and
    /// may leave no chain.
    pub across: f64,
    /// Longest step from the end of one layer to the start of the next: 0.73 w, 1.1 mm for clay. Longer steps
    /// reach more starts, but a step rises while it moves, and a long one sags.
    pub reach: f64,
    /// Spacing of the places that are tried along each cycle: w / 6, 0.25 mm for clay. Finer finds shorter
    /// steps; the time grows with the square of the inverse.
    pub spacing: f64,
    /// What a turn by more than 130° at either end of a step costs, mm²: as much as a step of its square root. A nozzle that
    /// goes back on its own way heaps clay; a quarter of w² lets it walk w / 2 for a smooth one.
    pub sharp: f64,
}

impl SeamSettings {
    /// For a bead of width `w` mm of the paper's clay.
    #[must_use]
    pub fn for_width(w: f64) -> Self {
        Self { across: 0.3 * w, reach: 0.73 * w, spacing: w / 6.0, sharp: 0.25 * w * w }
    }

    fn check(&self) -> Result<(), SeamError> {
        let values = [
            ("across", self.across, true),
            ("reach", self.reach, false),
            ("spacing", self.spacing, false),
            ("sharp", self.sharp, true),
        ];
        match values.into_iter().find(|&(_, x, zero)| !(x.is_finite() && (x > 0.0 || x == 0.0 && zero))) {
            Some((name, value, _)) => Err(SeamError::Setting { name, value }),
            None => Ok(()),
        }
    }
}

impl Default for SeamSettings {
    fn default() -> Self {
        Self::for_width(1.5)
    }
}

/// For each cycle (bottom first) the arc length of its start, such that the strand climbs in the cheapest
/// steps.
///
/// The strand of a layer is closed: it ends where it started, and rises from there to the start of the next.
/// In the chain
/// - each start but the lowest lies within `across` of the cycle below: it is held;
/// - each step is no longer than `reach`;
/// - each step touches the cycle that it leads to nowhere but at its end, or running straight along the
///   strand it ends on: it crosses nothing;
/// - the sum of the squared steps, of `sharp` for each turn by more than 130° at an end of a step, and of
///   `cost(layer, point)` for each start is the least possible among
///   starts at the spacing of the settings. A cost that is infinite or not a number forbids a start.
///
/// The paper has each layer start at a point that the layer below contains (Sec. 3.3) and does not say how it is
/// found; the nearest one, layer by layer, ends up over nothing. Dynamic programming over all layers does not
/// where a chain exists. The layers may be any closed curves; no cycles give no starts.
///
/// # Errors
/// [`SeamError::Setting`] for settings that are not positive numbers (`across` and `sharp` may be 0),
/// [`SeamError::NoStart`] when the cost forbids the whole lowest layer, [`SeamError::NoStep`] with the layer
/// and the place when no chain leads further.
///
/// # Complexity
/// O(n k) for n candidates in all and k within reach of one. 250 layers of 4,000 candidates take about 0.1 s.
///
/// # Example
/// ```
/// use argil_seam::{ClosedCurve, DVec2, SeamSettings, seam_chain};
/// // A square tower that leans: each layer 0.2 mm further to the right.
/// let square = [(0.0, 0.0), (6.0, 0.0), (6.0, 6.0), (0.0, 6.0)].map(DVec2::from);
/// let tower: Result<Vec<_>, _> = (0..20)
///     .map(|k| ClosedCurve::new(square.iter().map(|p| p + DVec2::new(0.2 * f64::from(k), 0.0)).collect()))
///     .collect();
/// let tower = tower?;
/// let starts = seam_chain(&tower, &SeamSettings::for_width(1.5), &|_, _| 0.0)?;
/// for layer in 1..tower.len() {
///     let start = tower[layer].point_at(starts[layer]);
///     let step = start.distance(tower[layer - 1].point_at(starts[layer - 1]));
///     // Along the sides that lean the strand need not move at all but for the spacing of the places tried.
///     assert!(step < 0.25 && tower[layer - 1].nearest(start).distance < 0.45);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn seam_chain(
    cycles: &[ClosedCurve],
    settings: &SeamSettings,
    cost: &dyn Fn(usize, DVec2) -> f64,
) -> Result<Vec<f64>, SeamError> {
    seam_chain_among(cycles, &[], settings, cost)
}

/// The same with one more start a layer: the places at arc lengths `also`, bottom first, are tried beside those at the spacing
/// of the settings. A chain that is known to exist is found by this however narrow it is. Arcs beyond the number of cycles and such
/// that are not finite are passed over.
///
/// # Errors
/// As [`seam_chain`].
///
/// # Complexity
/// As [`seam_chain`].
///
/// # Example
/// ```
/// use argil_seam::{ClosedCurve, DVec2, SeamSettings, seam_chain_among};
/// let square = [(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)].map(DVec2::from).to_vec();
/// let tower = vec![ClosedCurve::new(square)?; 3];
/// // Nothing is as cheap as what was known before.
/// let known = 7.0;
/// let cost = |layer: usize, start: DVec2| tower[layer].point_at(known).distance(start);
/// let starts = seam_chain_among(&tower, &[known; 3], &SeamSettings::for_width(1.5), &cost)?;
/// assert_eq!(starts, [known; 3]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn seam_chain_among(
    cycles: &[ClosedCurve],
    also: &[f64],
    settings: &SeamSettings,
    cost: &dyn Fn(usize, DVec2) -> f64,
) -> Result<Vec<f64>, SeamError> {
    settings.check()?;
    if cycles.is_empty() {
        return Ok(Vec::new());
    }
    let mut plan = Plan::trusting(cycles, also, settings, cost)?;
    let mut rounds = 0;
    loop {
        let chain = plan.cheapest_chain();
        let crossing = plan.crossing_layers(&chain);
        if crossing.is_empty() {
            // Cheapest while some steps were trusted, and sound: so it is the cheapest of all sound chains.
            return Ok(plan.arcs_of(&chain));
        }
        rounds += 1;
        if rounds < TRUSTING_ROUNDS {
            plan.test(&crossing)?;
        } else {
            plan.test(&(1..cycles.len()).collect::<Vec<_>>())?;
        }
    }
}
