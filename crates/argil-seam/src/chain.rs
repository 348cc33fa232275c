//! The cheapest chain of starts through all layers.

use crate::SeamError;
use crate::candidates::{Candidates, Reached, ReachedGrid};
use crate::step::{is_clear, is_clear_by};
use argil_curve::{ClosedCurve, DVec2, Segment, SegmentIndex};
use std::cell::OnceCell;

/// Plans made before every layer's steps are tested for crossings. Each finds the layers where the cheapest chain crosses
/// something and tests those from then on; few layers ever need it, and testing all costs several times the rest.
const TRUSTING_PLANS: usize = 4;

/// The limits of a chain of starts. Lengths in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeamSettings {
    /// `ε_across` of the paste: a start lies no further than this from the cycle below. Smaller is safer and may leave no
    /// chain.
    pub across: f64,
    /// Longest step from the end of one layer to the start of the next: 0.73 w, 1.1 mm for clay. Longer steps reach more
    /// starts, but a step rises while it moves, and a long one sags.
    pub reach: f64,
    /// Spacing of the places that are tried along each cycle: w / 6, 0.25 mm for clay. Finer finds shorter steps; the time
    /// grows with the square of the inverse.
    pub spacing: f64,
}

impl SeamSettings {
    /// For a bead of width `w` mm of the paper's clay.
    pub fn for_width(w: f64) -> Self {
        Self { across: 0.3 * w, reach: 0.73 * w, spacing: w / 6.0 }
    }

    fn check(&self) -> Result<(), SeamError> {
        let lengths = [("across", self.across), ("reach", self.reach), ("spacing", self.spacing)];
        match lengths
            .into_iter()
            .find(|&(name, x)| !(x.is_finite() && (x > 0.0 || x == 0.0 && name == "across")))
        {
            Some((name, value)) => Err(SeamError::Setting { name, value }),
            None => Ok(()),
        }
    }
}

impl Default for SeamSettings {
    fn default() -> Self {
        Self::for_width(1.5)
    }
}

/// For each cycle (bottom first) the arc length of its start, such that the strand climbs in the cheapest steps.
///
/// The strand of a layer is closed: it ends where it started, and rises from there to the start of the next. In the chain
/// - each start but the lowest lies within `across` of the cycle below: it is held;
/// - each step is no longer than `reach`;
/// - each step touches the cycle that it leads to nowhere but at its end, or running straight along the strand it ends on:
///   it crosses nothing;
/// - the sum of the squared steps and of `cost(layer, point)` for each start is the least possible among starts at the
///   spacing of the settings. A cost that is infinite or not a number forbids a start.
///
/// The paper lets each layer begin near the last (Sec. 3.1), which leaves starts over nothing; dynamic programming over all
/// layers finds none where a chain exists. The layers may be any closed curves; no cycles give no starts.
///
/// # Errors
/// [`SeamError::Setting`] for settings that are not positive numbers (`across` may be 0), [`SeamError::NoStart`] when the cost forbids the whole
/// lowest layer, [`SeamError::NoStep`] with the layer and the place when no chain leads further.
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
    settings.check()?;
    if cycles.is_empty() {
        return Ok(Vec::new());
    }
    let mut planner =
        Planner { cycles, settings, cost, layers: Vec::new(), tested: vec![false; cycles.len()] };
    let mut lowest = 0;
    let mut plans = 0;
    loop {
        planner.plan_from(lowest)?;
        plans += 1;
        let chain = planner.cheapest_chain();
        let crossing = planner.crossing_layers(&chain);
        let Some(&first) = crossing.first() else {
            return Ok(chain
                .iter()
                .zip(&planner.layers)
                .map(|(&k, layer)| layer.candidates.arc(k))
                .collect());
        };
        // A chain that was the cheapest while some steps were trusted, and proves sound, is the cheapest of all sound
        // ones. One that crosses is planned again, from the first layer whose steps are now tested.
        if plans < TRUSTING_PLANS {
            crossing.iter().for_each(|&layer| planner.tested[layer] = true);
            lowest = first;
        } else {
            planner.tested.fill(true);
            lowest = 1;
        }
    }
}

/// What is known of one layer.
struct Layer {
    candidates: Candidates,
    /// Cost of the cheapest chain that ends at each candidate; infinite where none does.
    costs: Vec<f64>,
    /// The candidate of the layer below where that chain comes from.
    from: Vec<u32>,
}

struct Planner<'a> {
    cycles: &'a [ClosedCurve],
    settings: &'a SeamSettings,
    cost: &'a dyn Fn(usize, DVec2) -> f64,
    layers: Vec<Layer>,
    /// Whether the steps that lead to a layer are tested for crossings while planning.
    tested: Vec<bool>,
}

impl Planner<'_> {
    /// Plans the layers from `lowest` up; those below stay as they are.
    fn plan_from(&mut self, lowest: usize) -> Result<(), SeamError> {
        self.layers.truncate(lowest);
        for layer in lowest..self.cycles.len() {
            let planned = match layer.checked_sub(1) {
                None => self.lowest_layer(),
                Some(below) => self.layer_above(below),
            };
            if planned.costs.iter().all(|cost| cost.is_infinite()) {
                return Err(self.stuck(layer));
            }
            self.layers.push(planned);
        }
        Ok(())
    }

    fn lowest_layer(&self) -> Layer {
        let candidates = Candidates::along(&self.cycles[0], self.settings.spacing);
        let costs: Vec<f64> = candidates.points.iter().map(|&p| self.extra(0, p)).collect();
        let from = vec![0; costs.len()];
        Layer { candidates, costs, from }
    }

    fn layer_above(&self, below: usize) -> Layer {
        let layer = below + 1;
        let candidates = Candidates::along(&self.cycles[layer], self.settings.spacing);
        let under = &self.layers[below];
        let reached = ReachedGrid::over(&under.candidates.points, &under.costs, self.settings.reach);
        let ground = Ground { cycle: &self.cycles[below], index: OnceCell::new() };
        let steps = self.tested[layer].then(|| index_of(&self.cycles[layer]));
        let mut costs = vec![f64::INFINITY; candidates.points.len()];
        let mut from = vec![0; candidates.points.len()];
        for (k, &p) in candidates.points.iter().enumerate() {
            let extra = self.extra(layer, p);
            if extra.is_infinite() {
                continue;
            }
            let (best, nearest) = self.cheapest_below(&reached, p, (f64::NEG_INFINITY, 0));
            let Some(mut best) = best.filter(|_| ground.holds(p, nearest, self.settings.across)) else {
                continue;
            };
            if let Some(index) = &steps {
                let s = candidates.arc(k);
                let clear = |start| is_clear_by(index, &Segment::new(start, p), s, &self.cycles[layer]);
                let mut sound = Some(best);
                while let Some(next) = sound.filter(|next| !clear(next.point)) {
                    sound = self.cheapest_below(&reached, p, (next.cost, next.candidate)).0;
                }
                let Some(next) = sound else { continue };
                best = next;
            }
            costs[k] = best.cost + extra;
            from[k] = best.candidate;
        }
        Layer { candidates, costs, from }
    }

    /// The start below from which `p` is reached at the least cost (that of its chain and the squared step) among those
    /// that come after `beyond`, which is a cost and a candidate; and the distance of the nearest start of all.
    fn cheapest_below(&self, reached: &ReachedGrid, p: DVec2, beyond: (f64, u32)) -> (Option<Reached>, f64) {
        let limit = self.settings.reach * self.settings.reach;
        let mut nearest = f64::INFINITY;
        let mut best = Reached { point: p, cost: f64::INFINITY, candidate: 0 };
        reached.for_each_near(p, self.settings.reach, |start| {
            let squared = start.point.distance_squared(p);
            nearest = nearest.min(squared);
            let rank = (start.cost + squared, start.candidate);
            if squared <= limit && rank < (best.cost, best.candidate) && rank > beyond {
                best = Reached { cost: rank.0, ..*start };
            }
        });
        (Some(best).filter(|best| best.cost.is_finite()), nearest.sqrt())
    }

    /// The candidates of the cheapest chain, bottom first.
    fn cheapest_chain(&self) -> Vec<usize> {
        let Some(top) = self.layers.last() else { return Vec::new() };
        let mut k = 0;
        for (other, cost) in top.costs.iter().enumerate() {
            if *cost < top.costs[k] {
                k = other;
            }
        }
        let mut chain = Vec::with_capacity(self.layers.len());
        for layer in self.layers.iter().rev() {
            chain.push(k);
            k = layer.from[k] as usize;
        }
        chain.reverse();
        chain
    }

    /// The layers that the chain enters by a step that crosses or touches something, lowest first.
    fn crossing_layers(&self, chain: &[usize]) -> Vec<usize> {
        let place = |layer: usize| self.layers[layer].candidates.points[chain[layer]];
        (1..chain.len())
            .filter(|&layer| {
                let step = Segment::new(place(layer - 1), place(layer));
                !is_clear(&step, self.layers[layer].candidates.arc(chain[layer]), &self.cycles[layer])
            })
            .collect()
    }

    /// The caller's cost; infinite for what is not a number.
    fn extra(&self, layer: usize, p: DVec2) -> f64 {
        let extra = (self.cost)(layer, p);
        if extra.is_nan() { f64::INFINITY } else { extra }
    }

    /// Why `layer` cannot be reached.
    fn stuck(&self, layer: usize) -> SeamError {
        let Some(below) = layer.checked_sub(1).map(|below| &self.layers[below]) else {
            return SeamError::NoStart;
        };
        let index = index_of(&self.cycles[layer]);
        let mut error = (f64::INFINITY, DVec2::ZERO);
        for (&p, cost) in below.candidates.points.iter().zip(&below.costs) {
            let gap = index.distance(p);
            if cost.is_finite() && gap < error.0 {
                error = (gap, p);
            }
        }
        SeamError::NoStep { layer, below: error.1, gap: error.0 }
    }
}

/// The cycle that starts must lie over.
struct Ground<'a> {
    cycle: &'a ClosedCurve,
    /// Built when a start comes up that no near candidate decides.
    index: OnceCell<SegmentIndex>,
}

impl Ground<'_> {
    /// Whether `p` lies within `across` of the cycle, given its distance from the nearest candidate found on it.
    fn holds(&self, p: DVec2, nearest: f64, across: f64) -> bool {
        // A candidate lies on the cycle, so a near one decides; a far one proves nothing.
        nearest <= across
            || self.index.get_or_init(|| index_of(self.cycle)).nearest_within(p, across).is_some()
    }
}

fn index_of(cycle: &ClosedCurve) -> SegmentIndex {
    SegmentIndex::of_curves([cycle], cycle.length() / cycle.segment_count() as f64)
}
