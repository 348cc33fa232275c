//! Where a search starts: from the greedy edges, or from the tour that the caller brings.

use crate::Metric;
use crate::candidates::CandidateLists;
use alloc::vec;
use alloc::vec::Vec;

const NONE: u32 = u32::MAX;

/// After this many rounds of joining ends to their nearest, what is left is joined in a row. Each round halves
/// the paths unless many have the same nearest end.
const MOST_ROUNDS: usize = 12;

/// Greedy edge construction: take candidate edges from the shortest up wherever they neither close a cycle nor
/// give a node a third neighbour, then join the paths that are left, end to nearest end.
///
/// Bentley, "Fast algorithms for geometric traveling salesman problems" (1992), DOI 10.1287/ijoc.4.4.387: of the
/// simple constructions the best start for a local search, because its mistakes are few and long.
#[derive(Clone, Debug, Default)]
pub(crate) struct GreedyEdge {
    edges: Vec<(f64, u32, u32)>,
    neighbours: Vec<[u32; 2]>,
    /// For an end of a path its other end, which of a single node is the node itself.
    other_end: Vec<u32>,
    ends: Vec<u32>,
}

impl GreedyEdge {
    /// Writes a tour of all nodes into `order`.
    ///
    /// The candidate edges are sorted; joining p paths takes O(p²) distances a round, and p is about a tenth of
    /// the number of nodes.
    pub(crate) fn construct<M: Metric>(
        &mut self,
        metric: &M,
        candidates: &CandidateLists,
        order: &mut Vec<u32>,
    ) {
        self.make_paths(metric.nodes(), candidates, 1);
        for _ in 0..MOST_ROUNDS {
            if !self.join_ends(metric) {
                break;
            }
        }
        self.string_together(metric, order);
    }

    /// Joins `n` single nodes by candidate edges until no more than `enough` paths are left or no edge fits.
    pub(crate) fn make_paths(&mut self, n: usize, candidates: &CandidateLists, enough: usize) {
        self.neighbours.clear();
        self.neighbours.resize(n, [NONE; 2]);
        self.other_end.clear();
        self.other_end.extend(0..n as u32);
        self.edges.clear();
        for a in 0..n as u32 {
            let once = candidates.of(a).iter().filter(|candidate| a < candidate.node);
            self.edges.extend(once.map(|candidate| (candidate.distance, a, candidate.node)));
        }
        let mut left = n;
        self.join_shortest_first(|| {
            left -= 1;
            left > enough
        });
        self.ends.clear();
        self.ends.extend((0..n as u32).filter(|&a| self.neighbours[a as usize][1] == NONE));
    }

    /// The two ends of each path, once.
    pub(crate) fn paths(&self) -> impl Iterator<Item = (u32, u32)> + '_ {
        self.ends.iter().map(|&end| (end, self.other_end[end as usize])).filter(|(a, b)| a <= b)
    }

    /// Appends the nodes of the path that has the end `from`, beginning there.
    pub(crate) fn walk_path(&self, from: u32, order: &mut Vec<u32>) {
        let to = self.other_end[from as usize];
        let (mut before, mut at) = (NONE, from);
        order.push(at);
        while at != to {
            let [one, two] = self.neighbours[at as usize];
            (before, at) = (at, if one == before { two } else { one });
            order.push(at);
        }
    }

    /// Joins the two ends of each edge in the list, shortest first, where that makes a longer path, for as long
    /// as `go_on` says so after a join.
    fn join_shortest_first(&mut self, mut go_on: impl FnMut() -> bool) {
        self.edges.sort_unstable_by(|x, y| x.0.total_cmp(&y.0).then((x.1, x.2).cmp(&(y.1, y.2))));
        for k in 0..self.edges.len() {
            let (_, a, b) = self.edges[k];
            if self.is_end(a) && self.is_end(b) && self.other_end[a as usize] != b {
                self.join(a, b);
                if !go_on() {
                    return;
                }
            }
        }
    }

    fn is_end(&self, a: u32) -> bool {
        self.neighbours[a as usize][1] == NONE
    }

    fn join(&mut self, a: u32, b: u32) {
        for (from, to) in [(a, b), (b, a)] {
            let slots = &mut self.neighbours[from as usize];
            slots[usize::from(slots[0] != NONE)] = to;
        }
        let (far_a, far_b) = (self.other_end[a as usize], self.other_end[b as usize]);
        self.other_end[far_a as usize] = far_b;
        self.other_end[far_b as usize] = far_a;
    }

    /// One round: the edges from each end to its nearest end of another path, shortest first. Says whether any
    /// two paths were joined.
    fn join_ends<M: Metric>(&mut self, metric: &M) -> bool {
        self.edges.clear();
        let count = self.ends.len();
        for k in 0..count {
            let a = self.ends[k];
            let mut nearest = (f64::INFINITY, NONE);
            // Beginning with the next end, so that equal points do not all choose the same one.
            for &b in self.ends[k + 1..].iter().chain(&self.ends[..k]) {
                let distance = metric.distance(a as usize, b as usize);
                if distance < nearest.0 && self.other_end[a as usize] != b {
                    nearest = (distance, b);
                }
            }
            if nearest.1 != NONE {
                self.edges.push((nearest.0, a, nearest.1));
            }
        }
        let mut joined = false;
        self.join_shortest_first(|| {
            joined = true;
            true
        });
        let neighbours = &self.neighbours;
        self.ends.retain(|&a| neighbours[a as usize][1] == NONE);
        joined
    }

    /// Writes the paths one after the other, each time going on to the nearest end that is left.
    fn string_together<M: Metric>(&mut self, metric: &M, order: &mut Vec<u32>) {
        order.clear();
        let mut next = self.ends.first().copied();
        while let Some(entry) = next {
            self.walk_path(entry, order);
            let exit = self.other_end[entry as usize];
            self.ends.retain(|&end| end != entry && end != exit);
            let mut nearest: Option<(f64, u32)> = None;
            for &end in &self.ends {
                let distance = metric.distance(exit as usize, end as usize);
                if nearest.is_none_or(|(least, _)| distance < least) {
                    nearest = Some((distance, end));
                }
            }
            next = nearest.map(|(_, end)| end);
        }
    }
}

/// Makes a tour of all nodes from the caller's: what is no node or comes a second time is dropped, and what is
/// missing is inserted where it lengthens the tour least.
///
/// So a layer may start from the tour of the layer above although supports came and went. O(n) for each missing
/// node; a permutation is taken as it is.
pub(crate) fn mend<M: Metric>(metric: &M, start: &[usize], order: &mut Vec<u32>) {
    let n = metric.nodes();
    let mut present = vec![false; n];
    order.clear();
    for &node in start {
        if node < n && !present[node] {
            present[node] = true;
            order.push(node as u32);
        }
    }
    for node in (0..n).filter(|&node| !present[node]) {
        let mut best: Option<(f64, usize)> = None;
        for k in 0..order.len() {
            let (a, b) = (order[k] as usize, order[(k + 1) % order.len()] as usize);
            let detour = metric.distance(a, node) + metric.distance(node, b) - metric.distance(a, b);
            if best.is_none_or(|(least, _)| detour < least) {
                best = Some((detour, k + 1));
            }
        }
        order.insert(best.map_or(0, |(_, place)| place), node as u32);
    }
}
