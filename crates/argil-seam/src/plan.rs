//! The costs of all starts, layer by layer, and the cheapest chain through them.

use crate::candidates::{Candidates, Reached, ReachedGrid};
use crate::step::{is_clear, is_clear_by, sharp_turns};
use crate::{SeamError, SeamSettings};
use argil_curve::{ClosedCurve, DVec2, Segment, SegmentIndex};
#[cfg(feature = "rayon")]
use rayon::prelude::*;
use std::ops::Range;
use std::sync::OnceLock;

/// Layers whose places are found at once. The chain may break off at any layer, and what is found beyond is of no use.
const BATCH: usize = 16;

/// Fewer places than this are not worth another thread.
#[cfg(feature = "rayon")]
const FEWEST_SHARED: usize = 128;

/// What is known of one layer.
struct Layer {
    candidates: Candidates,
    /// Cost of the cheapest chain that ends at each candidate; infinite where none does.
    costs: Vec<f64>,
    /// The candidate of the layer below where that chain comes from.
    from: Vec<u32>,
    /// The segments of the layer's cycle, once the steps that lead to it are tested for crossings.
    tested: Option<SegmentIndex>,
}

/// The costs of all starts.
///
/// To test each step for crossings takes as long as all the rest, and the cheapest chain hardly ever crosses
/// anything. So steps are trusted at first, and tested in the layers where the cheapest chain turns out to
/// cross. A test can only raise costs; a start keeps its cost as long as the one below that it comes from
/// does.
pub(crate) struct Plan<'a> {
    cycles: &'a [ClosedCurve],
    settings: &'a SeamSettings,
    cost: &'a dyn Fn(usize, DVec2) -> f64,
    layers: Vec<Layer>,
}

impl<'a> Plan<'a> {
    /// Plans all layers, and tests no step for crossings. `also` has the arc of one more start for each of the lowest cycles.
    pub(crate) fn trusting(
        cycles: &'a [ClosedCurve],
        also: &[f64],
        settings: &'a SeamSettings,
        cost: &'a dyn Fn(usize, DVec2) -> f64,
    ) -> Result<Self, SeamError> {
        let mut plan = Self { cycles, settings, cost, layers: Vec::with_capacity(cycles.len()) };
        for first in (0..cycles.len()).step_by(BATCH) {
            let batch = first..(first + BATCH).min(cycles.len());
            for (layer, candidates) in batch.clone().zip(places_along(batch, cycles, also, settings.spacing))
            {
                let extras: Vec<f64> = candidates.points.iter().map(|&p| plan.extra(layer, p)).collect();
                let (costs, from) = match layer.checked_sub(1) {
                    None => (extras, vec![0; candidates.points.len()]),
                    Some(below) => Ascent::new(&cycles[below], &plan.layers[below], settings)
                        .reached(&candidates, &extras),
                };
                plan.layers.push(Layer { candidates, costs, from, tested: None });
                plan.check(layer)?;
            }
        }
        Ok(plan)
    }

    /// Tests the steps that lead to `layers` (ascending, none the lowest) from now on, and mends the costs.
    pub(crate) fn test(&mut self, layers: &[usize]) -> Result<(), SeamError> {
        let lowest = layers.first().copied().unwrap_or(self.layers.len());
        // The starts of the layer below whose cost has risen.
        let mut risen: Vec<bool> = Vec::new();
        for layer in lowest..self.layers.len() {
            let newly = layers.binary_search(&layer).is_ok() && self.layers[layer].tested.is_none();
            if newly {
                self.layers[layer].tested = Some(index_of(&self.cycles[layer]));
            }
            let stale = self.stale_starts(layer, &risen, newly);
            risen = self.mend(layer, &stale);
            self.check(layer)?;
        }
        Ok(())
    }

    /// The starts whose chain comes from one whose cost has risen or, in a layer newly tested, by a step that
    /// is not clear.
    fn stale_starts(&self, layer: usize, risen: &[bool], newly: bool) -> Vec<usize> {
        if !newly && !risen.contains(&true) {
            return Vec::new();
        }
        let here = &self.layers[layer];
        let below = &self.layers[layer - 1].candidates;
        let is_stale = |k: usize| {
            let from = here.from[k] as usize;
            let has_risen = risen.get(from).copied().unwrap_or(false);
            has_risen || newly && !self.is_sound(layer, k, below.points[from])
        };
        (0..here.costs.len()).filter(|&k| here.costs[k].is_finite() && is_stale(k)).collect()
    }

    /// Finds the cheapest chains to the stale starts of a layer anew; says which starts cost more than
    /// before.
    fn mend(&mut self, layer: usize, stale: &[usize]) -> Vec<bool> {
        let mut risen = vec![false; self.layers[layer].costs.len()];
        if stale.is_empty() {
            return risen;
        }
        let ascent = Ascent::new(&self.cycles[layer - 1], &self.layers[layer - 1], self.settings);
        let Candidates { points, headings, .. } = &self.layers[layer].candidates;
        let mended: Vec<(f64, u32)> = stale
            .iter()
            .map(|&k| {
                match ascent
                    .cheapest_where(points[k], headings[k].leaving, |start| self.is_sound(layer, k, start))
                {
                    Some(best) => (best.cost + self.extra(layer, points[k]), best.candidate),
                    None => (f64::INFINITY, 0),
                }
            })
            .collect();
        let here = &mut self.layers[layer];
        for (&k, (cost, from)) in stale.iter().zip(mended) {
            risen[k] = cost > here.costs[k];
            (here.costs[k], here.from[k]) = (cost, from);
        }
        risen
    }

    /// Whether the step from `start` to candidate `k` crosses nothing; taken for granted where steps are not
    /// tested.
    fn is_sound(&self, layer: usize, k: usize, start: DVec2) -> bool {
        let here = &self.layers[layer];
        here.tested.as_ref().is_none_or(|index| {
            let step = Segment::new(start, here.candidates.points[k]);
            is_clear_by(index, &step, here.candidates.arcs[k], &self.cycles[layer])
        })
    }

    /// The candidates of the cheapest chain, bottom first.
    pub(crate) fn cheapest_chain(&self) -> Vec<usize> {
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
    pub(crate) fn crossing_layers(&self, chain: &[usize]) -> Vec<usize> {
        let place = |layer: usize| self.layers[layer].candidates.points[chain[layer]];
        (1..chain.len())
            .filter(|&layer| {
                let step = Segment::new(place(layer - 1), place(layer));
                !is_clear(&step, self.layers[layer].candidates.arcs[chain[layer]], &self.cycles[layer])
            })
            .collect()
    }

    /// The arc lengths of the candidates of a chain.
    pub(crate) fn arcs_of(&self, chain: &[usize]) -> Vec<f64> {
        chain.iter().zip(&self.layers).map(|(&k, layer)| layer.candidates.arcs[k]).collect()
    }

    /// The caller's cost; infinite for what is not a number.
    fn extra(&self, layer: usize, p: DVec2) -> f64 {
        let extra = (self.cost)(layer, p);
        if extra.is_nan() { f64::INFINITY } else { extra }
    }

    /// Fails when no chain reaches `layer`.
    fn check(&self, layer: usize) -> Result<(), SeamError> {
        if self.layers[layer].costs.iter().any(|cost| cost.is_finite()) {
            return Ok(());
        }
        let Some(below) = layer.checked_sub(1).map(|below| &self.layers[below]) else {
            return Err(SeamError::NoStart);
        };
        let index = index_of(&self.cycles[layer]);
        let mut nearest = (f64::INFINITY, DVec2::ZERO);
        for (&p, cost) in below.candidates.points.iter().zip(&below.costs) {
            let gap = index.distance(p);
            if cost.is_finite() && gap < nearest.0 {
                nearest = (gap, p);
            }
        }
        Err(SeamError::NoStep { layer, below: nearest.1, gap: nearest.0 })
    }
}

/// The places of some layers. None depends on another layer.
fn places_along(layers: Range<usize>, cycles: &[ClosedCurve], also: &[f64], spacing: f64) -> Vec<Candidates> {
    #[cfg(feature = "rayon")]
    let layers = layers.into_par_iter();
    layers.map(|layer| Candidates::along(&cycles[layer], spacing, also.get(layer).copied())).collect()
}

/// The way up from one layer.
struct Ascent<'a> {
    reached: ReachedGrid,
    cycle: &'a ClosedCurve,
    /// The segments of `cycle`, built when a start comes up that no near candidate shows to be held.
    ground: OnceLock<SegmentIndex>,
    settings: &'a SeamSettings,
}

impl<'a> Ascent<'a> {
    fn new(cycle: &'a ClosedCurve, layer: &Layer, settings: &'a SeamSettings) -> Self {
        let reached = ReachedGrid::over(&layer.candidates, &layer.costs, settings.reach);
        Self { reached, cycle, ground: OnceLock::new(), settings }
    }

    /// For each candidate of the next layer, which itself costs `extras`, the cost of the cheapest chain to it and where it comes from.
    fn reached(&self, candidates: &Candidates, extras: &[f64]) -> (Vec<f64>, Vec<u32>) {
        let places = 0..candidates.points.len();
        #[cfg(feature = "rayon")]
        let places = places.into_par_iter().with_min_len(FEWEST_SHARED);
        let reached = |k: usize| {
            let best = extras[k]
                .is_finite()
                .then(|| self.cheapest(candidates.points[k], candidates.headings[k].leaving));
            best.flatten().map_or((f64::INFINITY, 0), |best| (best.cost + extras[k], best.candidate))
        };
        places.map(reached).unzip()
    }

    /// The start below from which `p` is reached at the least cost, which is that of its chain, the
    /// squared step and its sharp turns; the lowest candidate among equals. `None` if there is none within reach or `p`
    /// is not held. The walk goes on from `p` in the direction `leaving`.
    fn cheapest(&self, p: DVec2, leaving: DVec2) -> Option<Reached> {
        self.cheapest_after(p, leaving, |_, _| true)
    }

    /// The same among starts that are `sound`.
    fn cheapest_where(&self, p: DVec2, leaving: DVec2, sound: impl Fn(DVec2) -> bool) -> Option<Reached> {
        let mut best = self.cheapest(p, leaving);
        while let Some(next) = best.filter(|next| !sound(next.point)) {
            best = self.cheapest_after(p, leaving, |cost, candidate| {
                (cost, candidate) > (next.cost, next.candidate)
            });
        }
        best
    }

    fn cheapest_after(
        &self,
        p: DVec2,
        leaving: DVec2,
        admitted: impl Fn(f64, u32) -> bool,
    ) -> Option<Reached> {
        let limit = self.settings.reach * self.settings.reach;
        let mut nearest = f64::INFINITY;
        let mut best = Reached { point: p, arriving: leaving, cost: f64::INFINITY, candidate: 0 };
        self.reached.for_each_near(p, |start| {
            let squared = start.point.distance_squared(p);
            nearest = nearest.min(squared);
            let mut cost = start.cost + squared;
            if cost <= best.cost && squared <= limit {
                cost +=
                    self.settings.sharp * f64::from(sharp_turns(start.arriving, p - start.point, leaving));
            }
            if cost <= best.cost && squared <= limit {
                let better = cost < best.cost || start.candidate < best.candidate;
                if better && admitted(cost, start.candidate) {
                    best = Reached { cost, ..*start };
                }
            }
        });
        (best.cost.is_finite() && self.is_held(p, nearest.sqrt())).then_some(best)
    }

    /// Whether `p` lies within `across` of the cycle, given its distance from the nearest candidate on it
    /// that was seen.
    fn is_held(&self, p: DVec2, nearest: f64) -> bool {
        // A candidate lies on the cycle, so a near one decides; a far one proves nothing.
        let across = self.settings.across;
        nearest <= across || self.ground.get_or_init(|| index_of(self.cycle)).is_within(p, across)
    }
}

fn index_of(cycle: &ClosedCurve) -> SegmentIndex {
    SegmentIndex::of_curves([cycle], cycle.length() / cycle.segment_count() as f64)
}
