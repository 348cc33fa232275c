//! Which nodes may become neighbours on the tour.

use crate::Metric;
use alloc::vec::Vec;

/// A candidate neighbour and its distance, side by side because the search always needs both.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    pub(crate) distance: f64,
    pub(crate) node: u32,
}

/// So many distances are compared at a time.
const LANES: usize = 16;

/// For each node its candidate neighbours, nearest first.
///
/// The lists are symmetric: a node deep inside a dense patch is nobody's choice from outside, but whoever leaves
/// the patch is found from within.
#[derive(Clone, Debug, Default)]
pub(crate) struct CandidateLists {
    /// The list of node `a` is `entries[starts[a] .. starts[a + 1]]`.
    starts: Vec<u32>,
    entries: Vec<Candidate>,
    /// Directed pairs before they are sorted into lists.
    pairs: Vec<(u32, Candidate)>,
    nearest: Vec<Candidate>,
}

impl CandidateLists {
    /// How many nodes have a list.
    pub(crate) fn nodes(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// The candidates of node `a`, nearest first, ties in the order of their numbers.
    #[inline]
    pub(crate) fn of(&self, a: u32) -> &[Candidate] {
        &self.entries[self.starts[a as usize] as usize..self.starts[a as usize + 1] as usize]
    }

    /// Every node's `count` nearest nodes and `extra` neighbours, each pair in both lists.
    ///
    /// O(n²) distances are asked for; what is stored is in O(n · `count` + extra).
    pub(crate) fn build<M: Metric>(&mut self, metric: &M, count: usize, extra: &[Vec<u32>]) {
        let n = metric.nodes();
        let count = count.min(n.saturating_sub(1));
        self.pairs.clear();
        for a in 0..n {
            self.find_nearest(metric, a, count);
            for &candidate in &self.nearest {
                add_pair(&mut self.pairs, a as u32, candidate);
            }
            for &b in extra.get(a).map_or(&[][..], Vec::as_slice) {
                if (b as usize) < n && b as usize != a {
                    let distance = metric.distance(a, b as usize);
                    add_pair(&mut self.pairs, a as u32, Candidate { distance, node: b });
                }
            }
        }
        self.sort_into_lists(n);
    }

    /// The `count` nearest nodes of `a`. It begins with the next node, so that equal points do not all choose the same few.
    fn find_nearest<M: Metric>(&mut self, metric: &M, a: usize, count: usize) {
        self.nearest.clear();
        if count == 0 {
            return;
        }
        let n = metric.nodes();
        if let Some(row) = metric.row(a).filter(|row| row.len() == n) {
            self.enter_nearest(&row[a + 1..], a + 1, count);
            self.enter_nearest(&row[..a], 0, count);
        } else {
            for b in (a + 1..n).chain(0..a) {
                self.enter(Candidate { distance: metric.distance(a, b), node: b as u32 }, count);
            }
        }
    }

    /// Enters those of a run of distances, which begins with that to the node `first`, that are among the `count` least so far.
    fn enter_nearest(&mut self, distances: &[f64], first: usize, count: usize) {
        for (k, few) in distances.chunks(LANES).enumerate() {
            let least = few.iter().copied().fold(f64::INFINITY, |a, b| if b < a { b } else { a });
            if self.nearest.len() == count && self.nearest.last().is_none_or(|last| least >= last.distance) {
                continue;
            }
            for (node, &distance) in (first + k * LANES..).zip(few) {
                self.enter(Candidate { distance, node: node as u32 }, count);
            }
        }
    }

    /// Enters a candidate unless `count` are as near.
    #[inline]
    fn enter(&mut self, candidate: Candidate, count: usize) {
        if self.nearest.len() == count {
            if self.nearest.last().is_none_or(|last| candidate.distance >= last.distance) {
                return;
            }
            self.nearest.pop();
        }
        let place = self.nearest.iter().rposition(|c| c.distance <= candidate.distance).map_or(0, |k| k + 1);
        self.nearest.insert(place, candidate);
    }

    /// Counting sort of the pairs by their first node, then each list by distance, each pair kept once.
    fn sort_into_lists(&mut self, n: usize) {
        self.starts.clear();
        self.starts.resize(n + 2, 0);
        for &(a, _) in &self.pairs {
            self.starts[a as usize + 2] += 1;
        }
        for a in 2..n + 2 {
            self.starts[a] += self.starts[a - 1];
        }
        self.entries.clear();
        self.entries.resize(self.pairs.len(), Candidate { distance: 0.0, node: 0 });
        for &(a, candidate) in &self.pairs {
            let end = &mut self.starts[a as usize + 1];
            self.entries[*end as usize] = candidate;
            *end += 1;
        }
        let mut kept = 0;
        let mut from = 0;
        for a in 0..n {
            let to = self.starts[a + 1] as usize;
            self.entries[from..to]
                .sort_unstable_by(|x, y| x.distance.total_cmp(&y.distance).then(x.node.cmp(&y.node)));
            let start = kept;
            for k in from..to {
                if kept == start || self.entries[kept - 1].node != self.entries[k].node {
                    self.entries[kept] = self.entries[k];
                    kept += 1;
                }
            }
            self.starts[a] = start as u32;
            from = to;
        }
        self.starts[n] = kept as u32;
        self.starts.truncate(n + 1);
        self.entries.truncate(kept);
    }
}

fn add_pair(pairs: &mut Vec<(u32, Candidate)>, a: u32, candidate: Candidate) {
    pairs.push((a, candidate));
    pairs.push((candidate.node, Candidate { node: a, ..candidate }));
}
