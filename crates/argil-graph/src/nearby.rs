//! Which of some vertices are near each other, without all distances among them.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::PathGraph;

/// A source that reached a vertex, and by which length.
#[derive(Clone, Copy, Debug)]
struct Label {
    length: f64,
    source: u32,
    settled: bool,
}

/// A label that waits for its turn. Lengths are not negative, so that their bits order them.
type Waiting = Reverse<(u64, u32, u32)>;

impl PathGraph {
    /// For each of the vertices `among`, the indices in that list of its `count` nearest others and of those
    /// whose cells touch its own, where a cell is the part of the graph that is nearest to one of them.
    ///
    /// These are the pairs that a short tour through `among` may have as neighbours: the nearest alone are
    /// all inside of a dense patch, and the cells say what lies across the gap. Nearest ones come first in each
    /// list, then the others in ascending order; of equally near ones the lower index counts as nearer.
    /// Paths never pass through an attachment. Of a vertex that is named several times only the first
    /// mention is near to anything.
    ///
    /// # Complexity
    /// O(c E log(c V)) for c = `count`; no distances between all pairs are made.
    ///
    /// # Example
    /// ```
    /// use argil_graph::PathGraph;
    /// use glam::dvec2;
    ///
    /// let row = (0..4).map(|k| dvec2(f64::from(k), 0.0)).collect();
    /// let graph = PathGraph::from_edges(row, &[], &[], &[(0, 1, 1.0), (1, 2, 1.0), (2, 3, 7.0)])?;
    /// // The nearest to vertex 2 is 1; the cell beside its own on the other side is that of 3.
    /// assert_eq!(graph.nearby(&[0, 1, 2, 3], 1), [vec![1], vec![0, 2], vec![1, 3], vec![2]]);
    /// # Ok::<(), argil_graph::GraphError>(())
    /// ```
    #[must_use]
    pub fn nearby(&self, among: &[u32], count: usize) -> Vec<Vec<u32>> {
        let reached = Reached::spread(self, among, count.min(among.len().saturating_sub(1)) + 1);
        let mut cells: Vec<(u32, u32)> = Vec::new();
        for (a, b, _) in self.edges() {
            if let (Some(p), Some(q)) = (reached.owner(a), reached.owner(b))
                && p != q
            {
                cells.extend([(p, q), (q, p)]);
            }
        }
        cells.sort_unstable();
        cells.dedup();
        let mut rest = cells.as_slice();
        let mut lists = Vec::with_capacity(among.len());
        for (k, &vertex) in among.iter().enumerate() {
            let k = k as u32;
            let (touching, later) = rest.split_at(rest.partition_point(|pair| pair.0 <= k));
            rest = later;
            let own = reached.labels(vertex);
            let mut list: Vec<u32> = if own.first().is_some_and(|label| label.source == k) {
                own[1..].iter().map(|label| label.source).collect()
            } else {
                Vec::new()
            };
            let nearest = list.len();
            for &(_, other) in touching {
                if !list[..nearest].contains(&other) {
                    list.push(other);
                }
            }
            lists.push(list);
        }
        lists
    }
}

/// For every vertex the nearest few sources.
struct Reached {
    /// The labels of vertex v are the first `counts[v]` from `v * most` on, nearest first.
    labels: Vec<Label>,
    counts: Vec<u32>,
    most: usize,
}

impl Reached {
    /// Spreads from all sources at once until `most` of them have reached every vertex. A source that is
    /// among the nearest of a vertex is so on the whole way to it, for whoever is nearer there is nearer here.
    fn spread(graph: &PathGraph, among: &[u32], most: usize) -> Self {
        let count = graph.vertex_count();
        let nothing = Label { length: f64::INFINITY, source: u32::MAX, settled: false };
        let mut reached = Self { labels: vec![nothing; most * count], counts: vec![0; count], most };
        let mut waiting: BinaryHeap<Waiting> = BinaryHeap::with_capacity(2 * count);
        let mut is_source = vec![false; count];
        for (k, &vertex) in among.iter().enumerate() {
            if let Some(known @ false) = is_source.get_mut(vertex as usize) {
                *known = true;
                reached.lower(vertex, k as u32, 0.0);
                waiting.push(Reverse((0, k as u32, vertex)));
            }
        }
        while let Some(Reverse((bits, source, vertex))) = waiting.pop() {
            let length = f64::from_bits(bits);
            if !reached.settle(vertex, source, length) || (length > 0.0 && graph.is_attachment(vertex)) {
                continue;
            }
            for (next, weight) in graph.neighbours(vertex) {
                let longer = length + weight;
                if reached.lower(next, source, longer) {
                    waiting.push(Reverse((longer.to_bits(), source, next)));
                }
            }
        }
        reached
    }

    fn labels(&self, vertex: u32) -> &[Label] {
        let v = vertex as usize;
        self.counts.get(v).map_or(&[], |&count| &self.labels[v * self.most..v * self.most + count as usize])
    }

    fn owner(&self, vertex: u32) -> Option<u32> {
        self.labels(vertex).first().map(|label| label.source)
    }

    /// Marks a label as final; whether it still stood and was not final before.
    fn settle(&mut self, vertex: u32, source: u32, length: f64) -> bool {
        let start = vertex as usize * self.most;
        let own = &mut self.labels[start..start + self.counts[vertex as usize] as usize];
        match own.iter_mut().find(|label| label.source == source) {
            Some(label) if !label.settled && label.length == length => {
                label.settled = true;
                true
            }
            _ => false,
        }
    }

    /// Enters a label unless the source is known to be as near, or `most` others are nearer.
    fn lower(&mut self, vertex: u32, source: u32, length: f64) -> bool {
        let count = self.counts[vertex as usize] as usize;
        let start = vertex as usize * self.most;
        let own = &mut self.labels[start..start + self.most];
        let known = own[..count].iter().position(|label| label.source == source);
        let mut place = match known {
            Some(place) if own[place].length <= length => return false,
            Some(place) => place,
            None if count < self.most => {
                self.counts[vertex as usize] += 1;
                count
            }
            None if (own[count - 1].length, own[count - 1].source) <= (length, source) => return false,
            None => count - 1,
        };
        while place > 0 && (own[place - 1].length, own[place - 1].source) > (length, source) {
            own[place] = own[place - 1];
            place -= 1;
        }
        own[place] = Label { length, source, settled: false };
        true
    }
}
