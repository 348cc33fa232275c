//! What the model asks for and what it got: wall paths without a bead, outline without clay.

use crate::sampling::{runs, samples};
use crate::settings::Tolerance;
use crate::wanted::{Wanted, within};
use argil_curve::{DVec2, SegmentIndex};

/// Lengths in mm.
#[derive(Clone, Debug, Default)]
pub(crate) struct Coverage {
    /// Wall path that the model asks for, and what of it has no bead.
    pub(crate) wanted: f64,
    pub(crate) missed: f64,
    /// Outline of the model, and what of it no bead reaches.
    pub(crate) outline: f64,
    pub(crate) uncovered: f64,
    /// Loops of which more than the tolerance is missing.
    pub(crate) missed_loops: usize,
    /// Middle and length of every stretch of wall path without a bead.
    pub(crate) stretches: Vec<(DVec2, f64)>,
    /// The same of outline that no bead reaches, where that is more than a corner.
    pub(crate) bare: Vec<(DVec2, f64)>,
}

/// Compares the wall paths and outlines of a layer with the beads laid in it.
pub(crate) fn measure(wanted: &Wanted, laid: &SegmentIndex, width: f64, t: &Tolerance) -> Coverage {
    let mut coverage = Coverage::default();
    for wall in &wanted.walls {
        let samples = samples(wall, t.outline_step);
        let bare: Vec<bool> = samples.iter().map(|s| !laid.is_within(s.at, t.laid)).collect();
        let found = runs(samples.len(), true, |k| bare[k], |k| samples[k].length);
        let missed: f64 = found.iter().map(|run| run.length).sum();
        coverage.wanted += samples.iter().map(|s| s.length).sum::<f64>();
        coverage.missed += missed;
        coverage.missed_loops += usize::from(missed > t.missed);
        coverage.stretches.extend(found.iter().map(|run| (samples[run.middle].at, run.length)));
    }
    let reach = 0.5 * width + t.uncovered;
    for outline in &wanted.outlines {
        let samples = samples(outline, t.outline_step);
        let is_bare: Vec<bool> = samples.iter().map(|s| within(laid, s.at, reach) == f64::INFINITY).collect();
        let found = runs(samples.len(), true, |k| is_bare[k], |k| samples[k].length);
        coverage.outline += samples.iter().map(|s| s.length).sum::<f64>();
        coverage.uncovered += found.iter().map(|run| run.length).sum::<f64>();
        let more = found.iter().filter(|run| run.length > width);
        coverage.bare.extend(more.map(|run| (samples[run.middle].at, run.length)));
    }
    coverage
}
