//! A path of the layer, sample by sample: whose it is and on which side of the wall it runs.

use crate::cycle::Path;
use crate::sampling::samples;
use crate::settings::Tolerance;
use crate::wanted::{Side, Wanted};
use argil_curve::DVec2;

/// A short piece of a path and what the model says of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    pub(crate) at: DVec2,
    /// Height of the nozzle over it, mm.
    pub(crate) z: f64,
    /// Length of the piece, mm.
    pub(crate) length: f64,
    /// Arc length of its middle from the beginning of the path, mm.
    pub(crate) arc: f64,
    pub(crate) is_fill: bool,
    /// Distance to the nearest wall path, mm; infinity beyond one bead.
    pub(crate) wall_distance: f64,
    /// The piece lies on a wall path.
    pub(crate) is_model: bool,
    pub(crate) side: Side,
}

impl Piece {
    /// Neither wall nor fill: what will be broken off.
    pub(crate) fn is_nonmodel(&self) -> bool {
        !self.is_model && !self.is_fill
    }
}

/// Cuts `path` into pieces no longer than `step` and asks the model about each.
pub(crate) fn pieces(path: &Path, wanted: &Wanted, step: f64, tolerance: &Tolerance) -> Vec<Piece> {
    let mut run = 0.0;
    samples(&path.points, step)
        .into_iter()
        .map(|s| {
            run += s.length;
            let (wall_distance, side) = wanted.place(s.at, tolerance);
            let height = |k: usize| path.heights.get(k).copied().unwrap_or_default();
            Piece {
                at: s.at,
                z: height(s.segment) + s.share * (height(s.segment + 1) - height(s.segment)),
                length: s.length,
                arc: run - 0.5 * s.length,
                is_fill: path.fill.get(s.segment).copied().unwrap_or(false),
                wall_distance,
                is_model: wall_distance <= tolerance.on_wall,
                side,
            }
        })
        .collect()
}
