//! The shortest tour of a few nodes, by dynamic programming.
//!
//! Held and Karp, "A dynamic programming approach to sequencing problems" (1962), DOI 10.1137/0110015; found at the same time by
//! Bellman, DOI 10.1145/321105.321111.

use crate::Metric;
use alloc::vec::Vec;

/// Above this many nodes the table (two megabytes at 16 nodes) and the time grow out of proportion.
pub(crate) const MOST_NODES: usize = 16;

/// Lengths side by side in the table: rows of a multiple of this many are added and compared at once.
const LANES: usize = 4;

/// The table of shortest paths, kept from call to call.
#[derive(Clone, Debug, Default)]
pub(crate) struct HeldKarp {
    /// The row of `set` has at place `last` the shortest path from the fixed node through all of `set` to `last`,
    /// which is none of it; at the places of its members nothing that is used.
    shortest: Vec<[f64; LANES]>,
    /// The distances from each node, the fixed one included, to all.
    distances: Vec<[f64; LANES]>,
}

impl HeldKarp {
    /// Writes the shortest tour of a metric of at most [`MOST_NODES`] nodes into `order`.
    ///
    /// The last node is the fixed one, which leaves the `free` nodes below it numbered as they are.
    /// Time is in O(2ⁿ n²), memory in O(2ⁿ n).
    pub(crate) fn solve<M: Metric>(&mut self, metric: &M, order: &mut Vec<u32>) {
        let n = metric.nodes();
        order.clear();
        if n <= 3 {
            order.extend(0..n as u32);
            return;
        }
        let free = n - 1;
        let stride = free.div_ceil(LANES);
        self.distances.clear();
        self.distances.resize(n * stride, [0.0; LANES]);
        for a in 0..n {
            for b in 0..free {
                self.distances[a * stride + b / LANES][b % LANES] = metric.distance(a.max(b), a.min(b));
            }
        }
        match stride {
            1 => self.fill::<1>(free),
            2 => self.fill::<2>(free),
            3 => self.fill::<3>(free),
            // There are at most sixteen nodes.
            _ => self.fill::<4>(free),
        }
        let (distances, shortest) = (&self.distances, &self.shortest);
        let length_to = |set: usize, last: usize| shortest[set * stride + last / LANES][last % LANES];
        let distance = |a: usize, b: usize| distances[a * stride + b / LANES][b % LANES];
        // Walk back from the full set: each step is the one that the table was filled by.
        let mut set = (1 << free) - 1;
        let mut next = free;
        order.push(free as u32);
        while set != 0 {
            let mut best = None;
            for last in members(set) {
                // The first step back is from the fixed node, whose row has all distances.
                let length = length_to(set & !(1 << last), last) + distance(next, last);
                if best.is_none_or(|(least, _)| length < least) {
                    best = Some((length, last));
                }
            }
            let Some((_, last)) = best else { break };
            order.push(last as u32);
            set &= !(1 << last);
            next = last;
        }
    }

    /// Fills the table row by row; a row is kept in registers, for its length is known.
    fn fill<const STRIDE: usize>(&mut self, free: usize) {
        let (distances, _) = self.distances.as_chunks::<STRIDE>();
        let shortest = &mut self.shortest;
        shortest.clear();
        shortest.reserve(STRIDE << free);
        shortest.extend_from_slice(&distances[free]);
        for set in 1..1_usize << free {
            let mut row = [[f64::INFINITY; LANES]; STRIDE];
            for last in members(set) {
                let to_last = shortest[(set & !(1 << last)) * STRIDE + last / LANES][last % LANES];
                let from_last = &distances[last];
                for k in 0..STRIDE {
                    for lane in 0..LANES {
                        let length = to_last + from_last[k][lane];
                        row[k][lane] = if length < row[k][lane] { length } else { row[k][lane] };
                    }
                }
            }
            shortest.extend_from_slice(&row);
        }
    }
}

/// The positions of the bits of `set`, lowest first.
fn members(mut set: usize) -> impl Iterator<Item = usize> {
    core::iter::from_fn(move || {
        if set == 0 {
            return None;
        }
        let lowest = set.trailing_zeros() as usize;
        set &= set - 1;
        Some(lowest)
    })
}
