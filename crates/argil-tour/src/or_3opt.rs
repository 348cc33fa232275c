//! Local search: 2-opt, Or-opt and Or-3opt as one neighbourhood.

use crate::Metric;
use crate::array_tour::ArrayTour;
use crate::candidates::CandidateLists;

/// The nodes whose surroundings changed, first come first served: the complement of don't-look bits
/// (Bentley 1992), kept as a queue so that a kick costs nothing but the search round its ends.
#[derive(Clone, Debug, Default)]
pub(crate) struct WorkQueue {
    ring: Vec<u32>,
    waiting: Vec<bool>,
    head: usize,
    count: usize,
}

impl WorkQueue {
    pub(crate) fn reset(&mut self, n: usize) {
        self.ring.clear();
        self.ring.resize(n, 0);
        self.waiting.clear();
        self.waiting.resize(n, false);
        (self.head, self.count) = (0, 0);
    }

    pub(crate) fn push(&mut self, a: u32) {
        if !self.waiting[a as usize] {
            self.waiting[a as usize] = true;
            let tail = self.head + self.count;
            let n = self.ring.len();
            self.ring[if tail >= n { tail - n } else { tail }] = a;
            self.count += 1;
        }
    }

    fn pop(&mut self) -> Option<u32> {
        if self.count == 0 {
            return None;
        }
        let a = self.ring[self.head];
        self.head = if self.head + 1 == self.ring.len() { 0 } else { self.head + 1 };
        self.count -= 1;
        self.waiting[a as usize] = false;
        Some(a)
    }
}

/// An exchange of edges: t1 t2, t3 t4 and so on go, t2 t3, t4 t5, … and the last with t1 come.
#[derive(Clone, Copy, Debug)]
enum Move {
    /// 2-opt.
    Two([u32; 4]),
    /// A 2-opt move and a second that removes the edge that closed the first: the two segments change places
    /// and one of them is reversed. Or-opt with reversal is the case of a short segment.
    Successive([u32; 6]),
    /// Or-3opt: the two segments change places and keep their directions.
    Swapped([u32; 6]),
    /// The two segments keep their places and are reversed.
    BothReversed([u32; 6]),
}

pub(crate) struct LocalSearch<'a, M> {
    pub(crate) metric: &'a M,
    pub(crate) candidates: &'a CandidateLists,
    pub(crate) tour: &'a mut ArrayTour,
    pub(crate) queue: &'a mut WorkQueue,
    /// Gains up to this are rounding.
    pub(crate) least_gain: f64,
}

impl<M: Metric> LocalSearch<'_, M> {
    #[inline]
    pub(crate) fn distance(&self, a: u32, b: u32) -> f64 {
        self.metric.distance(a as usize, b as usize)
    }

    /// Improves the tour until no node in the queue has an improving move; returns by how much it got shorter.
    /// At most `most_moves` moves, which only a metric that breaks its contract reaches.
    pub(crate) fn descend(&mut self, most_moves: usize) -> f64 {
        let mut gained = 0.0;
        let mut moves = 0;
        while let Some(a) = self.queue.pop() {
            while moves < most_moves
                && let Some((gain, found)) = self.improving_move(a)
            {
                gained += gain;
                moves += 1;
                self.apply(found);
            }
        }
        gained
    }

    fn improving_move(&self, t1: u32) -> Option<(f64, Move)> {
        let mut best: Option<(f64, Move)> = None;
        let mut most = self.least_gain;
        let n = self.tour.len();
        for forward in [true, false] {
            // Everything below reads as if the tour ran from t2 forward to t1.
            let after = |a| if forward { self.tour.next(a) } else { self.tour.previous(a) };
            let before = |a| if forward { self.tour.previous(a) } else { self.tour.next(a) };
            let t2 = after(t1);
            let rank = |a| if forward { self.tour.steps(t2, a) } else { self.tour.steps(a, t2) };
            let removed = self.distance(t1, t2);
            for c3 in self.candidates.of(t2) {
                let t3 = c3.node;
                let gain1 = removed - c3.distance;
                if gain1 <= self.least_gain {
                    break;
                }
                let rank3 = rank(t3);
                if rank3 == n - 1 {
                    continue;
                }
                // 2-opt, and 3-opt moves that begin with it.
                if rank3 > 1 {
                    let t4 = before(t3);
                    let open2 = gain1 + self.distance(t3, t4);
                    let gain = open2 - self.distance(t4, t1);
                    if gain > most {
                        most = gain;
                        best = Some((gain, Move::Two([t1, t2, t3, t4])));
                    }
                    for c5 in self.candidates.of(t4) {
                        let t5 = c5.node;
                        let gain2 = open2 - c5.distance;
                        if gain2 <= most {
                            break;
                        }
                        if t5 == t3 {
                            continue;
                        }
                        let rank5 = rank(t5);
                        let t6 = if rank5 > rank3 {
                            before(t5)
                        } else if rank5 + 2 < rank3 {
                            after(t5)
                        } else {
                            continue;
                        };
                        let gain = gain2 + self.distance(t5, t6) - self.distance(t6, t1);
                        if gain > most {
                            most = gain;
                            best = Some((gain, Move::Successive([t1, t2, t3, t4, t5, t6])));
                        }
                    }
                }
                // Or-3opt: the other neighbour of t3.
                let t4 = after(t3);
                let open2 = gain1 + self.distance(t3, t4);
                for c5 in self.candidates.of(t4) {
                    let t5 = c5.node;
                    let gain2 = open2 - c5.distance;
                    if gain2 <= most {
                        break;
                    }
                    let rank5 = rank(t5);
                    if rank5 > rank3 {
                        continue;
                    }
                    if rank5 < rank3 {
                        let t6 = after(t5);
                        let gain = gain2 + self.distance(t5, t6) - self.distance(t6, t1);
                        if gain > most {
                            most = gain;
                            best = Some((gain, Move::Swapped([t1, t2, t3, t4, t5, t6])));
                        }
                    }
                    if rank5 > 0 {
                        let t6 = before(t5);
                        let gain = gain2 + self.distance(t5, t6) - self.distance(t6, t1);
                        if gain > most {
                            most = gain;
                            best = Some((gain, Move::BothReversed([t1, t2, t3, t4, t5, t6])));
                        }
                    }
                }
            }
            if best.is_some() {
                break;
            }
        }
        best
    }

    fn apply(&mut self, found: Move) {
        match found {
            Move::Two([t1, t2, t3, t4]) => self.tour.exchange(t1, t2, t3, t4),
            Move::Successive([t1, t2, t3, t4, t5, t6]) => {
                self.tour.exchange(t1, t2, t3, t4);
                self.tour.exchange(t1, t4, t5, t6);
            }
            Move::Swapped([t1, t2, t3, t4, t5, t6]) => {
                self.tour.exchange(t1, t2, t4, t3);
                self.tour.exchange(t1, t3, t5, t6);
                self.tour.exchange(t3, t5, t4, t2);
            }
            Move::BothReversed([t1, t2, t3, t4, t5, t6]) => {
                self.tour.exchange(t1, t2, t5, t6);
                self.tour.exchange(t2, t5, t4, t3);
            }
        }
        let ends: &[u32] = match &found {
            Move::Two(t) => t,
            Move::Successive(t) | Move::Swapped(t) | Move::BothReversed(t) => t,
        };
        ends.iter().for_each(|&a| self.queue.push(a));
    }
}
