//! Descent to a tour that no exchange of a few edges shortens.

use crate::Metric;
use crate::array_tour::ArrayTour;
use crate::candidates::CandidateLists;
use crate::exchange::{Cut, MOST_CUTS, pieces_joined};
use crate::work_queue::WorkQueue;

/// From how many of the best exchanges of one edge, and of two, the search goes on to one edge more. The last
/// step needs no entry, for it only closes.
const BREADTH: [usize; MOST_CUTS - 2] = [5, 3];
const WIDEST: usize = 5;

/// A search by sequential exchanges of two, three and four edges: Lin and Kernighan, "An effective heuristic
/// algorithm for the traveling-salesman problem" (1973), DOI 10.1287/opre.21.2.498, with the breadth of Helsgaun,
/// "An effective implementation of the Lin–Kernighan traveling salesman heuristic" (2000),
/// DOI 10.1016/S0377-2217(99)00284-2.
///
/// 2-opt is the exchange of two edges. Or-opt (Or, "Traveling salesman-type combinatorial problems and their relation to
/// the logistics of regional blood banking", 1976) and Or-3opt, which move a segment elsewhere with or without
/// turning it round, are among the exchanges of three. Exchanges that leave two cycles on the way to one are
/// tried like all others, because nothing is done to the tour before a gain is sure.
#[derive(Debug)]
pub(crate) struct LocalSearch<'a, M> {
    pub(crate) metric: &'a M,
    pub(crate) candidates: &'a CandidateLists,
    pub(crate) tour: &'a mut ArrayTour,
    pub(crate) queue: &'a mut WorkQueue,
    /// Gains up to this may be rounding, and would go round in circles. Not negative, so that every exchange is a
    /// gain and the descent ends.
    pub(crate) least_gain: f64,
    /// The first position and the number of positions at one of which a kick begins.
    pub(crate) district: (usize, usize),
    /// The edges that the exchange in question removes; how many, the search knows.
    cuts: [Cut; MOST_CUTS],
}

/// A further edge to remove, and what the exchange would gain were there no edge to close it with.
#[derive(Clone, Copy, Default)]
struct Branch {
    cut: Cut,
    open: f64,
}

impl<'a, M: Metric> LocalSearch<'a, M> {
    pub(crate) fn new(
        metric: &'a M,
        candidates: &'a CandidateLists,
        tour: &'a mut ArrayTour,
        queue: &'a mut WorkQueue,
    ) -> Self {
        let edges = tour.stops().iter().map(|stop| stop.ahead.abs());
        let length: f64 = edges.filter(|edge| edge.is_finite()).sum();
        let district = (0, tour.len());
        // A sum of eight edges is off by some 1e-15 of the tour at most.
        Self {
            metric,
            candidates,
            tour,
            queue,
            least_gain: 1e-12 * length,
            district,
            cuts: [Cut::default(); MOST_CUTS],
        }
    }

    #[inline]
    pub(crate) fn distance(&self, a: u32, b: u32) -> f64 {
        self.metric.distance(a as usize, b as usize)
    }

    /// Shortens the tour until no node in the queue has a gainful exchange; returns by how much.
    ///
    /// There are at most `most` exchanges, a bound that only a metric that breaks its contract reaches.
    pub(crate) fn descend(&mut self, most: usize) -> f64 {
        let mut gained = 0.0;
        let mut exchanges = 0;
        while let Some(node) = self.queue.pop() {
            while exchanges < most {
                let gain = self.improve(node);
                if gain <= 0.0 {
                    break;
                }
                gained += gain;
                exchanges += 1;
            }
        }
        gained
    }

    /// Does the first gainful exchange found that removes an edge at `node`; returns the gain, or 0.
    fn improve(&mut self, node: u32) -> f64 {
        let at = self.tour.position(node);
        for (position, other, forward) in
            [(at, self.tour.after(at), true), (self.tour.before(at), self.tour.before(at), false)]
        {
            let to = self.tour.at(other).node;
            self.cuts[0] = Cut { position: position as u32, from: node, to, forward };
            let gain = self.extend(1, self.tour.at(position).ahead);
            if gain > 0.0 {
                return gain;
            }
        }
        0.0
    }

    /// Adds an edge and removes another, in every promising way, after the first `count` cuts, whose lengths
    /// less those of the edges added so far come to `open`. Does the first exchange that gains.
    fn extend(&mut self, count: usize, open: f64) -> f64 {
        let Some(&breadth) = BREADTH.get(count - 1) else { return self.close(count, open) };
        let start = self.cuts[0].from;
        let end = self.cuts[count - 1].to;
        let mut branches = [Branch::default(); WIDEST];
        let mut kept = 0;
        let candidates = self.candidates;
        for candidate in candidates.of(end) {
            let rest = open - candidate.distance;
            if rest <= self.least_gain {
                break;
            }
            for (cut, length) in self.edges_at(candidate.node) {
                let opened = rest + length;
                if opened <= self.least_gain || self.is_taken(count, &cut, end) {
                    continue;
                }
                // Two edges that are cut in the same direction cannot be closed to one cycle.
                if cut.to != start && (count > 1 || cut.forward != self.cuts[0].forward) {
                    let gain = opened - self.distance(start, cut.to);
                    if gain > self.least_gain && self.exchange(count, cut) {
                        return gain;
                    }
                }
                // Keep the widest open, best first.
                if kept < breadth || branches[kept - 1].open < opened {
                    kept = breadth.min(kept + 1);
                    let mut place = kept - 1;
                    while place > 0 && branches[place - 1].open < opened {
                        branches[place] = branches[place - 1];
                        place -= 1;
                    }
                    branches[place] = Branch { cut, open: opened };
                }
            }
        }
        for branch in &branches[..kept] {
            self.cuts[count] = branch.cut;
            let gain = self.extend(count + 1, branch.open);
            if gain > 0.0 {
                return gain;
            }
        }
        0.0
    }

    /// Like [`extend`](Self::extend), but for the last cut, after which the exchange must close. Two thirds of all
    /// edges are looked at here, mostly in vain, so that the length is asked first.
    fn close(&mut self, count: usize, open: f64) -> f64 {
        let start = self.cuts[0].from;
        let end = self.cuts[count - 1].to;
        let candidates = self.candidates;
        for candidate in candidates.of(end) {
            let rest = open - candidate.distance;
            if rest <= self.least_gain {
                break;
            }
            for (cut, length) in self.edges_at(candidate.node) {
                let gain = rest + length - self.distance(start, cut.to);
                if gain > self.least_gain
                    && cut.to != start
                    && !self.is_taken(count, &cut, end)
                    && self.exchange(count, cut)
                {
                    return gain;
                }
            }
        }
        0.0
    }

    /// The edges of the tour at `node`, as cuts from there, and their lengths.
    #[inline]
    fn edges_at(&self, node: u32) -> [(Cut, f64); 2] {
        let at = self.tour.position(node);
        let before = self.tour.before(at);
        let (next, previous) = (self.tour.at(self.tour.after(at)).node, self.tour.at(before));
        [
            (Cut { position: at as u32, from: node, to: next, forward: true }, self.tour.at(at).ahead),
            (Cut { position: before as u32, from: node, to: previous.node, forward: false }, previous.ahead),
        ]
    }

    /// Whether `cut` is among the first `count` cuts, or its node a neighbour of `end` on the tour already.
    #[inline]
    fn is_taken(&self, count: usize, cut: &Cut, end: u32) -> bool {
        let from = self.tour.position(cut.from);
        let end = self.tour.position(end);
        self.cuts[..count].iter().any(|other| other.position == cut.position)
            || self.tour.after(from) == end
            || self.tour.after(end) == from
    }

    /// Exchanges the first `count` cuts and `last` if that leaves one cycle, and queues their ends.
    fn exchange(&mut self, count: usize, last: Cut) -> bool {
        self.cuts[count] = last;
        let count = count + 1;
        let cuts = &self.cuts[..count];
        let Some(pieces) = pieces_joined(cuts, self.tour.len()) else { return false };
        let metric = self.metric;
        self.tour.rearrange(&pieces[..count], |a, b| metric.distance(a as usize, b as usize));
        for cut in cuts {
            self.queue.push(cut.from);
            self.queue.push(cut.to);
        }
        true
    }
}
