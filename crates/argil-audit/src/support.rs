//! What hangs in the air: stretches with no bead near enough below them.

use crate::sampling::{Run, runs};
use crate::strand::Piece;
use argil_curve::{DVec2, SegmentIndex};

/// Middle and length of each stretch longer than `bridge` mm with nothing of `below` within `across` mm.
///
/// The first `step_up` mm of the path are the step from the layer below: it is a run of its own, and what
/// follows is a cycle when `cyclic`. This is the continuous criterion (every maximal run of points not held
/// is at most `ε_along`); the paper's Eq. 1 tests samples `ε_along` apart and lets gaps of twice that pass.
pub(crate) fn hanging(
    pieces: &[Piece],
    below: &SegmentIndex,
    across: f64,
    bridge: f64,
    step_up: f64,
    cyclic: bool,
) -> Vec<(DVec2, f64)> {
    let bare: Vec<bool> = pieces.iter().map(|p| !below.is_within(p.at, across)).collect();
    let mut run = 0.0;
    let cut = pieces
        .iter()
        .position(|p| {
            run += p.length;
            run >= step_up
        })
        .unwrap_or(pieces.len());
    let stretches = |first: usize, last: usize, cyclic: bool| {
        let found = runs(last - first, cyclic, |k| bare[first + k], |k| pieces[first + k].length);
        found
            .into_iter()
            .filter(|run| run.length > bridge)
            .map(move |Run { middle, length, .. }| (first + middle, length))
    };
    stretches(0, cut, false)
        .chain(stretches(cut, pieces.len(), cyclic))
        .map(|(middle, length)| (pieces[middle].at, length))
        .collect()
}
