//! A smaller tour to begin with: paths instead of nodes.

use alloc::collections::BinaryHeap;
use alloc::vec;
use alloc::vec::Vec;
use core::cmp::Reverse;

use crate::Metric;
use crate::candidates::CandidateLists;
use crate::construction::GreedyEdge;

const NONE: u32 = u32::MAX;

/// How many nodes are passed at most on the way to the ends near an end: it is a tenth of the nodes that are ends.
const MOST_PASSED: usize = 400;

/// The ends of the paths that a greedy construction has made, numbered anew.
///
/// A tour through paths that are passed from end to end has few nodes and the large features of the tour through
/// all: which gaps between patches it crosses, and in which order. What takes kicks across a whole patch there
/// is an exchange of a few edges here. Walshaw, "A multilevel approach to the travelling salesman problem" (2002),
/// DOI 10.1287/opre.50.5.862.373, does so on many levels; between 200 and 1,600 nodes one does.
#[derive(Clone, Debug, Default)]
pub(crate) struct Contraction {
    /// The nodes that are ends of paths, both ends of a path next to each other.
    ends: Vec<u32>,
    /// For each end the other end of its path, or nothing if the path is a single node.
    mates: Vec<u32>,
}

impl Contraction {
    /// Takes over the ends of the paths in `paths`.
    pub(crate) fn set(&mut self, paths: &GreedyEdge) {
        self.ends.clear();
        self.mates.clear();
        for (a, b) in paths.paths() {
            let k = self.ends.len() as u32;
            self.ends.push(a);
            if a == b {
                self.mates.push(NONE);
            } else {
                self.ends.push(b);
                self.mates.extend([k + 1, k]);
            }
        }
    }

    /// The metric between the ends.
    pub(crate) fn metric<'a, M: Metric>(&'a self, metric: &'a M) -> PathMetric<'a, M> {
        PathMetric { metric, contraction: self }
    }

    /// For each end its mate and the first `count` other ends that are reached from candidate to candidate.
    ///
    /// These are the nearest ends or nearly so, and no distance is asked for.
    pub(crate) fn ends_near(&self, candidates: &CandidateLists, count: usize) -> Vec<Vec<u32>> {
        let nodes = candidates.nodes();
        let mut end_at = vec![NONE; nodes];
        for (&node, k) in self.ends.iter().zip(0..) {
            end_at[node as usize] = k;
        }
        // The least length by which a node was reached, and the search that says so.
        let mut reached = vec![(NONE, f64::INFINITY); nodes];
        let mut waiting: BinaryHeap<Reverse<(u64, u32)>> = BinaryHeap::new();
        let mut lists = Vec::with_capacity(self.ends.len());
        for (&from, end) in self.ends.iter().zip(0..) {
            let mate = self.mates[end as usize];
            let mut near: Vec<u32> = Some(mate).into_iter().filter(|&mate| mate != NONE).collect();
            waiting.clear();
            waiting.push(Reverse((0, from)));
            reached[from as usize] = (end, 0.0);
            let mut passed = 0;
            while let Some(Reverse((bits, node))) = waiting.pop() {
                // Distances are not negative, so that their bits order them.
                let length = f64::from_bits(bits);
                if length > reached[node as usize].1 {
                    continue;
                }
                passed += 1;
                let other = end_at[node as usize];
                if other != NONE && other != end && other != mate {
                    near.push(other);
                }
                if near.len() >= count || passed >= MOST_PASSED {
                    break;
                }
                for candidate in candidates.of(node) {
                    let longer = length + candidate.distance.max(0.0);
                    let known = &mut reached[candidate.node as usize];
                    if known.0 != end || longer < known.1 {
                        *known = (end, longer);
                        waiting.push(Reverse((longer.to_bits(), candidate.node)));
                    }
                }
            }
            lists.push(near);
        }
        lists
    }

    /// Puts the paths in place of their ends: `order` is a tour of the ends, in which mates are neighbours.
    pub(crate) fn expand(&self, order: &[u32], paths: &GreedyEdge, expanded: &mut Vec<u32>) {
        expanded.clear();
        let Some((&first, &last)) = order.first().zip(order.last()) else { return };
        // If the tour begins inside a path, its first node comes last.
        let split = order.len() > 2 && self.mates[first as usize] == last;
        let rotated = order[usize::from(split)..].iter().chain(&order[..usize::from(split)]);
        let mut entered = NONE;
        for &end in rotated {
            if self.mates[end as usize] == NONE {
                expanded.push(self.ends[end as usize]);
            } else if entered == NONE {
                entered = end;
            } else {
                paths.walk_path(self.ends[entered as usize], expanded);
                entered = NONE;
            }
        }
    }
}

/// The distances between the ends of paths. Two ends of one path are at −∞, so that the edge which stands for the
/// path comes first in every list, and every exchange that would remove it is a loss.
#[derive(Debug)]
pub(crate) struct PathMetric<'a, M> {
    metric: &'a M,
    contraction: &'a Contraction,
}

impl<M: Metric> Metric for PathMetric<'_, M> {
    fn nodes(&self) -> usize {
        self.contraction.ends.len()
    }

    #[inline]
    fn distance(&self, a: usize, b: usize) -> f64 {
        if self.contraction.mates[a] == b as u32 {
            f64::NEG_INFINITY
        } else {
            let ends = &self.contraction.ends;
            self.metric.distance(ends[a] as usize, ends[b] as usize)
        }
    }
}
