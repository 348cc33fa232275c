//! Where a search starts: from the greedy edges, or from the tour that the caller brings.

use crate::Metric;
use crate::candidates::CandidateLists;

const NONE: u32 = u32::MAX;

/// Greedy edge construction: take candidate edges from the shortest up wherever they neither close a cycle nor
/// give a node a third neighbour, then join the paths that are left, end to nearest end.
///
/// Bentley, "Fast algorithms for geometric traveling salesman problems" (1992), DOI 10.1287/ijoc.4.4.387: some 14 to 20 % above the
/// shortest tour, and the best of the simple starts for a local search, because its mistakes are few and long.
#[derive(Clone, Debug, Default)]
pub(crate) struct GreedyEdge {
    edges: Vec<(f64, u32, u32)>,
    neighbours: Vec<[u32; 2]>,
    /// For an end of a path its other end.
    other_end: Vec<u32>,
    ends: Vec<u32>,
}

impl GreedyEdge {
    /// Writes the tour into `order`. O(n log n) for the candidate edges, O(p²) for joining p paths; p is about a
    /// tenth of n.
    pub(crate) fn construct<M: Metric>(
        &mut self,
        metric: &M,
        candidates: &CandidateLists,
        order: &mut Vec<u32>,
    ) {
        let n = metric.nodes();
        self.edges.clear();
        for a in 0..n as u32 {
            self.edges
                .extend(candidates.of(a).iter().filter(|c| a < c.node).map(|c| (c.distance, a, c.node)));
        }
        self.edges.sort_unstable_by(|x, y| x.0.total_cmp(&y.0).then((x.1, x.2).cmp(&(y.1, y.2))));
        self.neighbours.clear();
        self.neighbours.resize(n, [NONE; 2]);
        self.other_end.clear();
        self.other_end.extend(0..n as u32);
        for k in 0..self.edges.len() {
            let (_, a, b) = self.edges[k];
            if self.is_end(a) && self.is_end(b) && self.other_end[a as usize] != b {
                self.join(a, b);
            }
        }
        self.ends.clear();
        self.ends.extend((0..n as u32).filter(|&a| self.neighbours[a as usize][1] == NONE));
        self.walk(metric, order);
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

    /// Walks the paths one after the other, each time on to the nearest end that is left.
    fn walk<M: Metric>(&mut self, metric: &M, order: &mut Vec<u32>) {
        order.clear();
        let Some(&first) = self.ends.first() else { return };
        let mut entry = first;
        loop {
            let exit = self.other_end[entry as usize];
            let (mut before, mut at) = (NONE, entry);
            loop {
                order.push(at);
                if at == exit {
                    break;
                }
                let [one, two] = self.neighbours[at as usize];
                (before, at) = (at, if one == before { two } else { one });
            }
            self.ends.retain(|&end| end != entry && end != exit);
            let mut nearest: Option<(f64, u32)> = None;
            for &end in &self.ends {
                let distance = metric.distance(exit as usize, end as usize);
                if nearest.is_none_or(|(least, _)| distance < least) {
                    nearest = Some((distance, end));
                }
            }
            let Some((_, next)) = nearest else { return };
            entry = next;
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
