//! The shortest tour of a few nodes, by dynamic programming.
//!
//! Held and Karp, "A dynamic programming approach to sequencing problems" (1962), DOI 10.1137/0110015; found at the same time by
//! Bellman, DOI 10.1145/321105.321111.

use crate::Metric;

/// Above this many nodes the table (two megabytes at 16 nodes) and the time grow out of proportion.
pub(crate) const MOST_NODES: usize = 16;

/// The table of shortest paths, kept from call to call.
#[derive(Clone, Debug, Default)]
pub(crate) struct HeldKarp {
    /// `shortest[set * free + last]`: the shortest path from the fixed node through all of `set`, which ends at
    /// its member `last`.
    shortest: Vec<f64>,
    distances: Vec<f64>,
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
        self.distances.clear();
        for a in 0..n {
            for b in 0..n {
                self.distances.push(metric.distance(a.max(b), a.min(b)));
            }
        }
        let distances = &self.distances;
        let shortest = &mut self.shortest;
        shortest.clear();
        shortest.resize(free << free, f64::INFINITY);
        for last in 0..free {
            shortest[(1 << last) * free + last] = distances[free * n + last];
        }
        for set in 1..1_usize << free {
            if set.is_power_of_two() {
                continue;
            }
            for last in members(set) {
                let before = set & !(1 << last);
                let mut least = f64::INFINITY;
                for previous in members(before) {
                    let length = shortest[before * free + previous] + distances[previous * n + last];
                    if length < least {
                        least = length;
                    }
                }
                shortest[set * free + last] = least;
            }
        }
        // Walk back from the full set: each step is the one that the table was filled by.
        let mut set = (1 << free) - 1;
        let mut next = free;
        order.push(free as u32);
        while set != 0 {
            let mut best = None;
            for last in members(set) {
                let length = shortest[set * free + last] + distances[last * n + next];
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
}

/// The positions of the bits of `set`, lowest first.
fn members(mut set: usize) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        if set == 0 {
            return None;
        }
        let lowest = set.trailing_zeros() as usize;
        set &= set - 1;
        Some(lowest)
    })
}
