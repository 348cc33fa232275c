use crate::PathGraph;
use crate::hierarchy::Hierarchy;

/// Finds shortest paths one after the other with the same buffers.
///
/// Both ends climb the hierarchy; the shortest path goes through the best vertex that both reach. The climb
/// from the last start is kept: many paths from one start cost little more than half.
///
/// # Example
/// ```
/// use argil_graph::{PathFinder, PathGraph};
/// use glam::dvec2;
///
/// let row = (0..4).map(|k| dvec2(f64::from(k), 0.0)).collect();
/// let graph = PathGraph::from_edges(row, &[], &[], &[(0, 1, 1.0), (1, 2, 1.0), (2, 3, 1.0)])?;
/// let mut finder = PathFinder::new(&graph);
/// assert_eq!(finder.path(0, 2), Some(vec![0, 1, 2]));
/// assert_eq!(finder.path(0, 3), Some(vec![0, 1, 2, 3]));
/// # Ok::<(), argil_graph::GraphError>(())
/// ```
#[derive(Clone, Debug)]
pub struct PathFinder<'g> {
    graph: &'g PathGraph,
    hierarchy: &'g Hierarchy,
    start: Option<u32>,
    from_start: Climb,
    from_end: Climb,
    /// Links still to be unpacked, the next one last.
    links: Vec<(u32, u32)>,
    /// One more than the place of a vertex in the path, zero if it is not on it.
    places: Vec<u32>,
}

impl PathGraph {
    /// A shortest path from one vertex to another with both ends, or none if there is no path. It never
    /// passes through an attachment and visits no vertex twice. Among equally short paths the choice is the
    /// same on every run; its length is the one that [`distances`](Self::distances) tells, up to rounding.
    ///
    /// For many paths a [`PathFinder`] saves the allocation of its buffers.
    ///
    /// # Complexity
    /// O(V) for the buffers and about O(√V log V) for the search on plane graphs. The first path or matrix of
    /// distances on a graph adds the elimination of its vertices, about as much time as a few Dijkstra searches.
    #[must_use]
    pub fn path(&self, from: u32, to: u32) -> Option<Vec<u32>> {
        PathFinder::new(self).path(from, to)
    }

    /// Shortest paths from one vertex to each of `targets`, as [`path`](Self::path) finds them.
    #[must_use]
    pub fn paths_from(&self, from: u32, targets: &[u32]) -> Vec<Option<Vec<u32>>> {
        let mut finder = PathFinder::new(self);
        targets.iter().map(|&to| finder.path(from, to)).collect()
    }
}

impl<'g> PathFinder<'g> {
    /// Buffers for paths in `graph`.
    ///
    /// # Complexity
    /// O(V), and the elimination if this is the first search in the graph.
    #[must_use]
    pub fn new(graph: &'g PathGraph) -> Self {
        let count = graph.vertex_count();
        PathFinder {
            graph,
            hierarchy: graph.hierarchy(),
            start: None,
            from_start: Climb::new(count),
            from_end: Climb::new(count),
            links: Vec::new(),
            places: vec![0; count],
        }
    }

    /// A shortest path, as [`PathGraph::path`] finds it.
    pub fn path(&mut self, from: u32, to: u32) -> Option<Vec<u32>> {
        let (first, last) = (self.hierarchy.rank(from)?, self.hierarchy.rank(to)?);
        if from == to {
            return Some(vec![from]);
        }
        if self.start != Some(first) {
            self.from_start.run(self.hierarchy, first);
            self.start = Some(first);
        }
        self.from_end.run(self.hierarchy, last);
        let top = self.from_start.meeting(&self.from_end);
        if let Some(weight) = self.edge_between_attachments(from, to)
            && top.is_none_or(|(length, _)| weight <= length)
        {
            return Some(vec![from, to]);
        }
        Some(self.unpack(from, top?.1))
    }

    fn edge_between_attachments(&self, from: u32, to: u32) -> Option<f64> {
        if !self.graph.is_attachment(from) || !self.graph.is_attachment(to) {
            return None;
        }
        self.graph.neighbours(from).find(|&(u, _)| u == to).map(|(_, weight)| weight)
    }

    /// The path that climbs from the start to rank `top` and descends to the end, in vertices.
    fn unpack(&mut self, from: u32, top: u32) -> Vec<u32> {
        // Both halves lead from the top outwards. The last link pushed is the first one unpacked, so the
        // descent goes first, back to front.
        self.links.clear();
        self.links.extend(self.from_end.way(top));
        self.links.reverse();
        self.links.extend(self.from_start.way(top).map(|(above, below)| (below, above)));

        let mut path = vec![from];
        self.places[from as usize] = 1;
        while let Some((a, b)) = self.links.pop() {
            if let Some(middle) = self.hierarchy.middle(a, b) {
                self.links.extend([(middle, b), (a, middle)]);
                continue;
            }
            let vertex = self.hierarchy.vertex(b);
            // A shortest path can come back to a vertex by edges of no weight: cut the detour off.
            let kept = match self.places[vertex as usize] {
                0 => path.len(),
                place => place as usize - 1,
            };
            for cut in path.drain(kept..) {
                self.places[cut as usize] = 0;
            }
            path.push(vertex);
            self.places[vertex as usize] = path.len() as u32;
        }
        for &vertex in &path {
            self.places[vertex as usize] = 0;
        }
        path
    }
}

/// The distances from one rank to all above it.
#[derive(Clone, Debug)]
struct Climb {
    reached: Vec<u32>,
    lengths: Vec<f64>,
    /// The rank that a rank was reached from.
    below: Vec<u32>,
}

impl Climb {
    fn new(count: usize) -> Climb {
        Climb { reached: Vec::new(), lengths: vec![f64::INFINITY; count], below: vec![u32::MAX; count] }
    }

    fn run(&mut self, hierarchy: &Hierarchy, from: u32) {
        for rank in self.reached.drain(..) {
            self.lengths[rank as usize] = f64::INFINITY;
            self.below[rank as usize] = u32::MAX;
        }
        // Until it is reached from below, a rank stands as reached from itself.
        let (reached, below) = (&mut self.reached, &mut self.below);
        hierarchy.climb(from, |rank| {
            let is_new = below[rank as usize] == u32::MAX;
            if is_new {
                below[rank as usize] = rank;
                reached.push(rank);
            }
            is_new
        });
        self.reached.sort_unstable();
        self.lengths[from as usize] = 0.0;
        for &rank in &self.reached {
            let here = self.lengths[rank as usize];
            let (to, weights) = hierarchy.links(rank);
            for (&next, &weight) in to.iter().zip(weights) {
                if here + weight < self.lengths[next as usize] {
                    self.lengths[next as usize] = here + weight;
                    self.below[next as usize] = rank;
                }
            }
        }
    }

    /// The rank that both climbs reach with the least length in sum (of equal ones the lowest), and that
    /// length.
    fn meeting(&self, other: &Climb) -> Option<(f64, u32)> {
        let mut best: Option<(f64, u32)> = None;
        for &rank in &self.reached {
            let length = self.lengths[rank as usize] + other.lengths[rank as usize];
            if length.is_finite() && best.is_none_or(|(shortest, _)| length < shortest) {
                best = Some((length, rank));
            }
        }
        best
    }

    /// The links from rank `top` down to where the climb began, each as `(above, below)`.
    fn way(&self, top: u32) -> impl Iterator<Item = (u32, u32)> + '_ {
        let mut above = top;
        std::iter::from_fn(move || {
            let below = self.below[above as usize];
            (below != above).then(|| (std::mem::replace(&mut above, below), below))
        })
    }
}
