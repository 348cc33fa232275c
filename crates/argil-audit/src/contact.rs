//! Where the non-model strand touches the wall: the roots where it leaves or joins, and contact beside them.

use crate::sampling::{Run, runs};
use crate::strand::Piece;
use crate::wanted::Side;
use argil_curve::DVec2;

/// Lengths in mm.
#[derive(Clone, Debug)]
pub(crate) struct Contact {
    /// Changes from wall to non-model strand and back.
    pub(crate) roots: usize,
    /// Non-model strand within one bead of the wall.
    pub(crate) touching: f64,
    /// The same outside of the model and apart from the roots: what has to be cleaned.
    pub(crate) outside: f64,
    /// Middle and length of each stretch that has to be cleaned.
    pub(crate) stretches: Vec<(DVec2, f64)>,
    /// For every piece, whether it lies further than the reach of a root along the path.
    pub(crate) apart: Vec<bool>,
}

/// Measures contact along one path; `reach` is the length in mm that belongs to a root on either side.
pub(crate) fn measure(pieces: &[Piece], width: f64, reach: f64) -> Contact {
    let roots: Vec<f64> =
        pieces.windows(2).filter(|p| p[0].is_model != p[1].is_model).map(|p| p[1].arc).collect();
    let apart: Vec<bool> = pieces.iter().map(|p| distance_to(&roots, p.arc) > reach).collect();
    let touches = |p: &Piece| p.is_nonmodel() && p.wall_distance < width;
    let dirty = |k: usize| touches(&pieces[k]) && apart[k] && pieces[k].side == Side::Outside;
    let found = runs(pieces.len(), false, dirty, |k| pieces[k].length);
    Contact {
        roots: roots.len(),
        touching: pieces.iter().filter(|p| touches(p)).map(|p| p.length).sum(),
        outside: found.iter().map(|run| run.length).sum(),
        stretches: found.iter().map(|&Run { middle, length }| (pieces[middle].at, length)).collect(),
        apart,
    }
}

/// Distance to the nearest of the ascending `marks`; infinity when there is none.
fn distance_to(marks: &[f64], at: f64) -> f64 {
    let next = marks.partition_point(|&m| m < at);
    let after = marks.get(next).map_or(f64::INFINITY, |m| m - at);
    let before = next.checked_sub(1).map_or(f64::INFINITY, |k| at - marks[k]);
    after.min(before)
}
