//! A tour in an array that is taken to pieces, put together anew, and brought back.

use alloc::vec::Vec;

/// A node on the tour and the edge that leaves it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Stop {
    pub(crate) node: u32,
    /// The distance to the next node. It is kept here because the search asks for the edges next to a node far
    /// more often than for any others, and a matrix of a thousand nodes fits no cache.
    pub(crate) ahead: f64,
}

/// The nodes at positions `first`, `first` + 1, … (cyclically), `length` of them; to be passed backwards if
/// `reversed`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Piece {
    pub(crate) first: u32,
    pub(crate) length: u32,
    pub(crate) reversed: bool,
}

/// A cyclic order of nodes with the position of each.
///
/// Every change, be it an exchange of edges or a kick, cuts the cycle into a few pieces and joins them in another
/// order, some of them reversed. The longest piece stays where it is and the rest is written anew. What stood
/// there goes to a journal, so that a failed kick is taken back at the price of what it changed, whatever the
/// length of the tour.
#[derive(Clone, Debug, Default)]
pub(crate) struct ArrayTour {
    stops: Vec<Stop>,
    position: Vec<u32>,
    /// What the changes since the last commit overwrote, window after window.
    overwritten: Vec<Stop>,
    /// Where each window begins, and how many stops it has.
    windows: Vec<(u32, u32)>,
}

impl ArrayTour {
    /// Takes over a permutation of the nodes below `order.len()`.
    pub(crate) fn set(&mut self, order: &[u32], distance: impl Fn(u32, u32) -> f64) {
        let n = order.len();
        self.position.clear();
        self.position.resize(n, 0);
        self.stops.clear();
        for (k, &node) in order.iter().enumerate() {
            self.position[node as usize] = k as u32;
            self.stops.push(Stop { node, ahead: distance(node, order[(k + 1) % n]) });
        }
        self.commit();
    }

    pub(crate) fn len(&self) -> usize {
        self.stops.len()
    }

    pub(crate) fn stops(&self) -> &[Stop] {
        &self.stops
    }

    #[inline]
    pub(crate) fn at(&self, position: usize) -> Stop {
        self.stops[position]
    }

    #[inline]
    pub(crate) fn position(&self, node: u32) -> usize {
        self.position[node as usize] as usize
    }

    #[inline]
    pub(crate) fn after(&self, position: usize) -> usize {
        if position + 1 == self.stops.len() { 0 } else { position + 1 }
    }

    #[inline]
    pub(crate) fn before(&self, position: usize) -> usize {
        if position == 0 { self.stops.len() - 1 } else { position - 1 }
    }

    /// Joins `pieces`, which together are the whole cycle, each with at least one node, in the order given.
    ///
    /// The cost is in the number of nodes outside the longest piece.
    pub(crate) fn rearrange(&mut self, pieces: &[Piece], distance: impl Fn(u32, u32) -> f64) {
        let n = self.stops.len();
        let count = pieces.len();
        let Some(longest) = (0..count).max_by_key(|&k| pieces[k].length) else { return };
        let kept = pieces[longest];
        // The window begins with the last stop of the piece that stays, because its edge changes too.
        let from = wrapped(kept.first as usize + kept.length as usize - 1, n);
        let window = n - kept.length as usize + 1;
        let saved = self.overwritten.len();
        self.windows.push((from as u32, window as u32));
        let unbroken = window.min(n - from);
        self.overwritten.extend_from_slice(&self.stops[from..from + unbroken]);
        self.overwritten.extend_from_slice(&self.stops[..window - unbroken]);
        let old = &self.overwritten[saved..];
        let mut to = from;
        for step in 1..count {
            // Should the longest piece be passed backwards, the whole cycle is, and the piece stays as it is.
            let next = if kept.reversed { longest + count - step } else { longest + step };
            let piece = pieces[wrapped(next, count)];
            let first = wrapped(piece.first as usize + n - from, n);
            let stops = &old[first..first + piece.length as usize];
            let backwards = piece.reversed != kept.reversed;
            let entry = if backwards { stops[stops.len() - 1] } else { stops[0] };
            self.stops[to].ahead = distance(self.stops[to].node, entry.node);
            for k in 0..stops.len() {
                let stop = if backwards {
                    let k = stops.len() - 1 - k;
                    // The first stop's edge is the one that the next piece sets.
                    Stop { node: stops[k].node, ahead: stops[k.saturating_sub(1)].ahead }
                } else {
                    stops[k]
                };
                to = wrapped(to + 1, n);
                self.stops[to] = stop;
                self.position[stop.node as usize] = to as u32;
            }
        }
        self.stops[to].ahead = distance(self.stops[to].node, self.stops[kept.first as usize].node);
    }

    /// Makes what was done so far final.
    pub(crate) fn commit(&mut self) {
        self.overwritten.clear();
        self.windows.clear();
    }

    /// Takes back every change since the last [`commit`](Self::commit).
    pub(crate) fn roll_back(&mut self) {
        let n = self.stops.len();
        while let Some((from, window)) = self.windows.pop() {
            let saved = self.overwritten.len() - window as usize;
            let mut to = from as usize;
            for &stop in &self.overwritten[saved..] {
                self.stops[to] = stop;
                self.position[stop.node as usize] = to as u32;
                to = wrapped(to + 1, n);
            }
            self.overwritten.truncate(saved);
        }
    }
}

/// `k` modulo `n`, for `k` below 2 `n`.
#[inline]
fn wrapped(k: usize, n: usize) -> usize {
    if k >= n { k - n } else { k }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn distance(a: u32, b: u32) -> f64 {
        f64::from(10 * a.max(b) + a.min(b))
    }

    fn tour(order: &[u32]) -> ArrayTour {
        let mut tour = ArrayTour::default();
        tour.set(order, distance);
        tour
    }

    fn order(tour: &ArrayTour) -> Vec<u32> {
        let n = tour.len();
        for k in 0..n {
            let stop = tour.at(k);
            assert_eq!(tour.position(stop.node), k);
            assert_eq!(stop.ahead, distance(stop.node, tour.at((k + 1) % n).node));
        }
        tour.stops().iter().map(|stop| stop.node).collect()
    }

    fn piece(first: u32, length: u32, reversed: bool) -> Piece {
        Piece { first, length, reversed }
    }

    #[test]
    fn pieces_are_joined_in_the_order_given() {
        let mut tour = tour(&[0, 1, 2, 3, 4, 5, 6, 7]);
        tour.rearrange(&[piece(6, 4, false), piece(4, 2, true), piece(2, 2, false)], distance);
        assert_eq!(order(&tour), [0, 1, 5, 4, 2, 3, 6, 7]);
    }

    #[test]
    fn a_longest_piece_that_is_reversed_turns_the_rest_instead() {
        let mut tour = tour(&[0, 1, 2, 3, 4, 5, 6, 7]);
        // 5 4 3 2 1 | 6 7 | 0, read backwards: 1 2 3 4 5 | 0 | 7 6.
        tour.rearrange(&[piece(1, 5, true), piece(6, 2, false), piece(0, 1, false)], distance);
        assert_eq!(order(&tour), [6, 1, 2, 3, 4, 5, 0, 7]);
    }

    #[test]
    fn rolling_back_restores_every_stop() {
        let mut tour = tour(&[3, 0, 4, 1, 5, 2, 6]);
        let before = order(&tour);
        tour.rearrange(&[piece(5, 4, false), piece(2, 3, true)], distance);
        tour.rearrange(&[piece(1, 2, false), piece(6, 2, true), piece(3, 3, true)], distance);
        assert_ne!(order(&tour), before);
        tour.roll_back();
        assert_eq!(order(&tour), before);
    }
}
