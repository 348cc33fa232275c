//! Straight ways between stops, which is all that it takes to sketch excursions: they chain stops that see each other, and
//! are drawn along shortest paths afterwards.

use std::cell::RefCell;
use std::collections::BTreeMap;

use argil_curve::{DVec2, Segment, SegmentIndex};

use crate::excursion::Hops;

/// How far a way keeps from its ends where it is tested for walls, in steps of the grid: a stop on a wall lies on either side of it
/// by rounding.
const OFF: f64 = 4.0;

/// Stops, and the walls between them.
pub(crate) struct Straight<'a, W> {
    /// Where the stops are.
    pub(crate) places: &'a [DVec2],
    pub(crate) walls: &'a SegmentIndex,
    /// Those whose strand hops across a spine: no way leads on from them.
    pub(crate) hopping: &'a [bool],
    /// The least that a way counts, as a share of its length.
    pub(crate) cheapest: f64,
    /// What a way counts that no wall crosses.
    pub(crate) weight: W,
    pub(crate) grid: f64,
    /// Ways that were asked about.
    pub(crate) known: RefCell<BTreeMap<(usize, usize), Option<f64>>>,
}

impl<W: Fn(DVec2, DVec2) -> f64> Hops for Straight<'_, W> {
    fn at_least(&self, a: usize, b: usize) -> f64 {
        self.cheapest * self.places[a].distance(self.places[b])
    }

    fn whole(&self, a: usize, b: usize) -> Option<f64> {
        let key = (a.min(b), a.max(b));
        if let Some(&known) = self.known.borrow().get(&key) {
            return known;
        }
        let (from, to) = (self.places[key.0], self.places[key.1]);
        let hops = |k: usize| self.hopping.get(k) == Some(&true);
        let whole = (!hops(a) && !hops(b) && !self.is_barred(from, to)).then(|| (self.weight)(from, to));
        self.known.borrow_mut().insert(key, whole);
        whole
    }
}

impl<W> Straight<'_, W> {
    /// Whether a wall crosses the way.
    fn is_barred(&self, from: DVec2, to: DVec2) -> bool {
        let off = (to - from).clamp_length_max(OFF * self.grid);
        let way = Segment::new(from + off, to - off);
        let mut barred = false;
        self.walls.for_each_near(way, 0.0, |_, wall| barred = barred || wall.crosses(&way));
        barred
    }
}
