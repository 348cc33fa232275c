//! How a layer rises on one that rises itself.

use std::ops::Range;

use argil_curve::DVec2;
use argil_support::Criterion;

use super::track::Track;
use super::under::Under;
use crate::plan::LevelCause;

/// The thinnest and the thickest bead of a layer that rises on one that rises, in turns: what it rises by in a turn is one.
pub(super) const BEAD: [f64; 2] = [0.55, 1.35];

/// The steepest rise: one turn within so many w.
pub(super) const STEEPEST: f64 = 3.0;

/// What lies farther down than this, in turns, holds nothing: 1.6 layer heights where nine layers share one more.
const DEEPEST: f64 = 1.44;

/// It is looked for this often along the path, in w, and so often on one stretch at most.
const SAMPLE: f64 = 0.1;
const MOST_SAMPLES: f64 = 64.0;

/// What rounding may take from the room between the lowest and the highest that a point may lie.
const NO_ROOM: f64 = 1e-9;

/// A turn of a run, and what it lies on.
pub(super) struct Slope<'a> {
    pub(super) track: &'a Track,
    /// The turn below, if that rises too.
    pub(super) under: Option<&'a Under>,
    /// How many turns of the run are laid with this one.
    pub(super) turn: f64,
    /// Within so much of either end of the path, mm, anything will do: there the step from turn to turn lies on strand of another turn.
    pub(super) seam: f64,
    pub(super) criterion: Criterion,
    pub(super) width: f64,
}

impl Slope<'_> {
    /// The height of each point, in turns: it rises from `turn - 1` to `turn` evenly along the path, or as nearly so as beads on what
    /// lies below allow. Where it must be, stretches no longer than the longest bridge are left out of account, as they are
    /// where nothing lies below.
    ///
    /// # Errors
    /// Why there is no such rise.
    pub(super) fn risen(&self) -> Result<Vec<f64>, LevelCause> {
        let length = self.track.length();
        if length.is_nan() || length <= STEEPEST * self.width {
            return Err(LevelCause::Short);
        }
        let even: Vec<f64> = self.track.arcs.iter().map(|arc| self.turn - 1.0 + arc / length).collect();
        let Some(under) = self.under else { return Ok(even) };
        let tops: Vec<Option<f64>> = self.track.points.iter().map(|&at| self.top(under, at)).collect();
        let bounds = |k: usize| {
            let [thin, thick] = BEAD;
            tops[k].filter(|_| !self.is_seam(k)).map(|top| [top + thin, top + thick])
        };
        let all: Vec<Option<[f64; 2]>> = (0..even.len()).map(bounds).collect();
        if let Some(levels) = self.held_between(&even, &all).filter(|levels| self.is_held(under, levels)) {
            return Ok(levels);
        }
        // Without those that the even rise misses for a short way only.
        let mut kept = all.clone();
        for run in self
            .runs(|k| tops[k].is_none() || all[k].is_some_and(|[low, high]| even[k] < low || even[k] > high))
        {
            if self.way(&run) <= self.criterion.along {
                kept[run].fill(None);
            }
        }
        let levels = self.held_between(&even, &kept).ok_or(LevelCause::Order)?;
        let is_loose = |k: usize| {
            tops[k].is_none()
                || all[k].is_some_and(|[low, high]| levels[k] < low - NO_ROOM || levels[k] > high + NO_ROOM)
        };
        let misses = |run: &Range<usize>| run.clone().any(|k| tops[k].is_some());
        let sound =
            self.runs(is_loose).iter().all(|run| !misses(run) || self.way(run) <= self.criterion.along);
        if sound && self.is_held(under, &levels) { Ok(levels) } else { Err(LevelCause::Order) }
    }

    /// Whether what lies too deep to hold anything, with what lies over nothing beside it, is nowhere longer than a bridge may be. Near
    /// the ends no height is limited, and what is below there may lie two turns down.
    fn is_held(&self, under: &Under, levels: &[f64]) -> bool {
        let (mut way, mut is_deep) = (0.0, false);
        for (k, stretch) in self.track.stretches().enumerate() {
            let length = stretch.length();
            let count = (length / (SAMPLE * self.width)).ceil().clamp(1.0, MOST_SAMPLES);
            for n in 0..count as usize {
                let share = (n as f64 + 0.5) / count;
                let level = levels[k] + (levels[k + 1] - levels[k]) * share;
                let depth = self.top(under, stretch.point_at(share)).map(|top| level - top);
                if depth.is_some_and(|depth| depth <= DEEPEST) {
                    (way, is_deep) = (0.0, false);
                    continue;
                }
                way += length / count;
                is_deep |= depth.is_some();
                if is_deep && way > self.criterion.along {
                    return false;
                }
            }
        }
        true
    }

    fn is_seam(&self, k: usize) -> bool {
        let arc = self.track.arcs[k];
        arc < self.seam || arc > self.track.length() - self.seam
    }

    fn top(&self, under: &Under, at: DVec2) -> Option<f64> {
        under.top(at, self.criterion.across).map(|(top, _)| top)
    }

    /// The maximal runs of points that something is true of.
    fn runs(&self, is_so: impl Fn(usize) -> bool) -> Vec<Range<usize>> {
        let mut runs: Vec<Range<usize>> = Vec::new();
        for k in (0..self.track.points.len()).filter(|&k| is_so(k)) {
            match runs.last_mut().filter(|run| run.end == k) {
                Some(run) => run.end = k + 1,
                None => runs.push(k..k + 1),
            }
        }
        runs
    }

    /// How long the way is on which a run of points lies, between the points before it and behind it.
    fn way(&self, run: &Range<usize>) -> f64 {
        let arcs = &self.track.arcs;
        arcs[run.end.min(arcs.len() - 1)] - arcs[run.start.saturating_sub(1)]
    }

    /// The even rise, held between bounds: of all heights that never fall, nor rise too steeply, the lowest and the highest that
    /// keep within them are found in a pass to and fro each. `None` where the two cross.
    fn held_between(&self, even: &[f64], bounds: &[Option<[f64; 2]>]) -> Option<Vec<f64>> {
        let last = even.len() - 1;
        let bound = |side: usize, none: f64| -> Vec<f64> {
            bounds.iter().map(|bound| bound.map_or(none, |bound| bound[side])).collect()
        };
        let (mut low, mut high) = (bound(0, self.turn - 1.0), bound(1, self.turn));
        (high[0], low[last]) = (self.turn - 1.0, self.turn);
        let most = |k: usize| (self.track.arcs[k + 1] - self.track.arcs[k]) / (STEEPEST * self.width);
        for k in 0..last {
            low[k + 1] = low[k + 1].max(low[k]);
        }
        for k in (0..last).rev() {
            high[k] = high[k].min(high[k + 1]);
            low[k] = low[k].max(low[k + 1] - most(k));
        }
        for k in 0..last {
            high[k + 1] = high[k + 1].min(high[k] + most(k));
        }
        let room = |(low, high): (&f64, &f64)| *low <= high + NO_ROOM;
        let within = |(&even, (&low, &high)): (&f64, (&f64, &f64))| even.max(low).min(high);
        let has_room = low.iter().zip(&high).all(room);
        has_room.then(|| even.iter().zip(low.iter().zip(&high)).map(within).collect())
    }
}
