//! Where the non-model strand touches the wall: the roots where it leaves or joins, and contact beside them.

use crate::ledger::ContactCause;
use crate::sampling::{Run, runs};
use crate::strand::Piece;
use crate::wanted::{Side, Wanted};
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
    /// Each stretch that touches outside of the model, at roots too.
    pub(crate) touches: Vec<Touch>,
    /// For every piece, whether it lies further than the reach of a root along the path.
    pub(crate) apart: Vec<bool>,
}

/// A stretch that touches the wall from outside of the model.
#[derive(Clone, Debug)]
pub(crate) struct Touch {
    /// Why, as far as its own layer tells.
    pub(crate) cause: ContactCause,
    pub(crate) middle: DVec2,
    /// Its length, mm.
    pub(crate) length: f64,
    /// Some points along it, about w/4 apart.
    pub(crate) points: Vec<DVec2>,
}

impl Touch {
    /// Whether at least half of the points are so.
    pub(crate) fn is_mostly(&self, so: impl Fn(DVec2) -> bool) -> bool {
        2 * self.points.iter().filter(|&&p| so(p)).count() >= self.points.len()
    }
}

/// Every so many pieces a touch keeps a point.
const THINNING: usize = 4;

/// Measures contact along one path; `reach` is the length in mm that belongs to a root on either side.
pub(crate) fn measure(pieces: &[Piece], wanted: &Wanted, width: f64, reach: f64) -> Contact {
    let roots: Vec<f64> =
        pieces.windows(2).filter(|p| p[0].is_model != p[1].is_model).map(|p| p[1].arc).collect();
    let apart: Vec<bool> = pieces.iter().map(|p| distance_to(&roots, p.arc) > reach).collect();
    let touches = |p: &Piece| p.is_nonmodel() && p.wall_distance < width;
    let dirty = |k: usize| touches(&pieces[k]) && apart[k] && pieces[k].side == Side::Outside;
    let found = runs(pieces.len(), false, dirty, |k| pieces[k].length);
    let at_root = |k: usize| touches(&pieces[k]) && !apart[k] && pieces[k].side == Side::Outside;
    let rooted = runs(pieces.len(), false, at_root, |k| pieces[k].length);
    let touch = |run: &Run| {
        let points = pieces[run.first..=run.last].iter().step_by(THINNING).map(|p| p.at).collect();
        Touch { cause: ContactCause::Root, middle: pieces[run.middle].at, length: run.length, points }
    };
    let caused = |run: &Run| {
        let mut touch = touch(run);
        touch.cause = if touch.is_mostly(|p| wanted.is_in_hole(p)) {
            ContactCause::Enclosed
        } else if touch.is_mostly(|p| wanted.is_between_walls(p)) {
            ContactCause::Narrow
        } else {
            ContactCause::Passing
        };
        touch
    };
    Contact {
        roots: roots.len(),
        touching: pieces.iter().filter(|p| touches(p)).map(|p| p.length).sum(),
        outside: found.iter().map(|run| run.length).sum(),
        stretches: found.iter().map(|run| (pieces[run.middle].at, run.length)).collect(),
        touches: rooted.iter().map(touch).chain(found.iter().map(caused)).collect(),
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
