//! Distances among many vertices on demand, from what each of them knows of the way up.
//!
//! Every vertex that is asked about keeps its distances to all vertices above it in the hierarchy, which are few. The
//! way between two vertices passes the lowest one that is above both or a later neighbour of that one, for these
//! together separate what lies below: the distance is the least sum over them. Ouyang, Qin, Chang, Lin, Zhang and Zhu,
//! *When Hierarchy Meets 2-Hop-Labeling*, <https://doi.org/10.1145/3183713.3196913>.

use crate::PathGraph;
use crate::hierarchy::Hierarchy;
use crate::matrix::NOWHERE;
use crate::sweeps::{LANES, Lanes, Sources, UNREACHED, lower};
use crate::vectors::{OverLanes, Vectors};

/// No vertex is above both.
const NO_TOP: u32 = u32::MAX;

/// Shortest path lengths between all pairs of a list of vertices, each found when it is asked for.
///
/// For T vertices this takes some T √V lengths of memory where a [`DistanceMatrix`](crate::DistanceMatrix) takes T²:
/// for 10,000 among 45,000 some 30 MB instead of 800. A length takes some ten to two hundred nanoseconds, the fewer the nearer
/// the vertices are to each other. See [`PathGraph::distances_on_demand`].
#[derive(Clone, Debug)]
pub struct DistanceLabels<'g> {
    graph: &'g PathGraph,
    hierarchy: &'g Hierarchy,
    /// For each entry of the list its place among the distinct vertices, which are in the order of rank.
    places: Vec<u32>,
    ranks: Vec<u32>,
    /// How many of the distinct vertices are attachments; they come first.
    attachments: usize,
    /// The label of place p is `lengths[starts[p]..starts[p + 1]]`. That of an attachment has one entry for each rank
    /// in `above`, any other one for each ancestor, the root first.
    starts: Vec<usize>,
    lengths: Vec<f64>,
    /// The ranks above the attachments, ascending for each, in step with `lengths`.
    above: Vec<u32>,
    tree: Tree,
    tops: Tops,
}

impl PathGraph {
    /// The lengths of shortest paths between all pairs of the vertices `among`, like [`distances`](Self::distances),
    /// but without a matrix of them.
    ///
    /// The lengths are those of the matrix: bit for bit when all weights are whole numbers and no length exceeds 2⁵³,
    /// otherwise up to the rounding of the sums. They are exactly symmetric, and zero from a vertex to itself.
    ///
    /// # Complexity
    /// For T vertices, each with h others above it that have w later neighbours each (h some multiple of √V, and w fewer, on
    /// plane graphs): O(T h w) time and O(T (h + log T)) memory, O(w) a length, O(h) if one end is an attachment. The first
    /// call on a graph adds the elimination, see [`path`](PathGraph::path).
    ///
    /// # Example
    /// ```
    /// use argil_graph::{DistanceLabels, PathGraph};
    /// use glam::dvec2;
    ///
    /// let corners = vec![dvec2(0.0, 0.0), dvec2(3.0, 0.0), dvec2(3.0, 4.0), dvec2(9.0, 9.0)];
    /// let graph = PathGraph::from_edges(corners, &[], &[], &[(0, 1, 3.0), (1, 2, 4.0)])?;
    /// let distances: DistanceLabels<'_> = graph.distances_on_demand(&[2, 0, 3]);
    /// assert_eq!(distances.get(0, 1), 7.0);
    /// assert_eq!(distances.get(0, 2), f64::INFINITY);
    /// # Ok::<(), argil_graph::GraphError>(())
    /// ```
    pub fn distances_on_demand(&self, among: &[u32]) -> DistanceLabels<'_> {
        let hierarchy = self.hierarchy();
        let Sources { ranks, places } = Sources::of(hierarchy, among);
        let attachments = ranks.partition_point(|&rank| hierarchy.is_attachment(rank));
        let tree = Tree::of(hierarchy);
        let tops = Tops::among(&ranks[attachments..], hierarchy);
        let mut labels = DistanceLabels {
            graph: self,
            hierarchy,
            places,
            attachments,
            starts: vec![0],
            lengths: Vec::new(),
            above: Vec::new(),
            tree,
            tops,
            ranks: Vec::new(),
        };
        let plain = &ranks[attachments..];
        let room = plain.iter().map(|&rank| labels.tree.depth(rank) + 1).sum();
        labels.lengths.reserve_exact(room);
        labels.starts.reserve_exact(ranks.len());
        let mut climb = SharedClimb::new(hierarchy);
        let vectors = Vectors::here();
        for sources in ranks.chunks(LANES) {
            vectors.run(Batch { climb: &mut climb, sources });
            for (lane, &rank) in sources.iter().enumerate() {
                labels.add(rank, lane, &climb.lengths);
            }
        }
        labels.ranks = ranks;
        labels
    }
}

impl DistanceLabels<'_> {
    /// How many vertices the list had.
    #[inline]
    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// Whether the list was empty.
    pub fn is_empty(&self) -> bool {
        self.places.is_empty()
    }

    /// The length of a shortest path from the vertex with index `i` in the list to the one with index `j`:
    /// infinite when there is none, and when an index is out of range.
    #[inline]
    pub fn get(&self, i: usize, j: usize) -> f64 {
        let place = |k: usize| self.places.get(k).copied().unwrap_or(NOWHERE);
        let (a, b) = (place(i), place(j));
        let (low, high) = (a.min(b) as usize, a.max(b));
        if high == NOWHERE {
            f64::INFINITY
        } else if low == high as usize {
            0.0
        } else if low >= self.attachments {
            self.between(low, high as usize)
        } else if (high as usize) < self.attachments {
            self.between_attachments(low, high as usize)
        } else {
            self.to_attachment(low, high as usize)
        }
    }

    #[inline]
    fn label(&self, place: usize) -> &[f64] {
        &self.lengths[self.starts[place]..self.starts[place + 1]]
    }

    /// What is above an attachment, and the distances from it.
    fn above(&self, place: usize) -> impl Iterator<Item = (u32, f64)> + '_ {
        // The labels of attachments come first, so that both lists run in step.
        let entries = self.starts[place]..self.starts[place + 1];
        self.above[entries.clone()].iter().copied().zip(self.lengths[entries].iter().copied())
    }

    /// The distance between two different places that are no attachments, the lower one first.
    #[inline]
    fn between(&self, low: usize, high: usize) -> f64 {
        let top = self.tops.between(low - self.attachments, high - self.attachments);
        if top == NO_TOP {
            return f64::INFINITY;
        }
        let (one, other) = (self.label(low), self.label(high));
        let depth = self.tree.depth(top);
        if depth + 1 == other.len() {
            return one[depth]; // the higher one is itself above the lower one
        }
        let mut least = one[depth] + other[depth];
        for &next in self.hierarchy.links(top).0 {
            let depth = self.tree.depth(next);
            let through = one[depth] + other[depth];
            least = if through < least { through } else { least };
        }
        least
    }

    fn to_attachment(&self, attachment: usize, place: usize) -> f64 {
        let (rank, label) = (self.ranks[place], self.label(place));
        let shared = self.above(attachment).filter(|&(above, _)| self.tree.is_above(above, rank));
        shared.map(|(above, length)| length + label[self.tree.depth(above)]).fold(f64::INFINITY, f64::min)
    }

    fn between_attachments(&self, low: usize, high: usize) -> f64 {
        let (one, other) = (self.hierarchy.vertex(self.ranks[low]), self.hierarchy.vertex(self.ranks[high]));
        let edge = self.graph.neighbours(one).find(|&(next, _)| next == other);
        let mut least = edge.map_or(f64::INFINITY, |(_, weight)| weight);
        let (mut left, mut right) = (self.above(low).peekable(), self.above(high).peekable());
        while let (Some(&(a, to_a)), Some(&(b, to_b))) = (left.peek(), right.peek()) {
            if a == b {
                least = least.min(to_a + to_b);
            }
            if a <= b {
                left.next();
            }
            if b <= a {
                right.next();
            }
        }
        least
    }

    /// Adds the label of the next place, whose lengths to all ranks above it stand in a lane.
    fn add(&mut self, rank: u32, lane: usize, lengths: &[Lanes]) {
        let start = self.lengths.len();
        if self.hierarchy.is_attachment(rank) {
            let first = self.above.len();
            for &next in self.hierarchy.links(rank).0 {
                self.above.extend(self.hierarchy.ancestors(next));
            }
            self.above[first..].sort_unstable();
            let mut kept = first;
            for k in first..self.above.len() {
                if kept == first || self.above[kept - 1] != self.above[k] {
                    self.above[kept] = self.above[k];
                    kept += 1;
                }
            }
            self.above.truncate(kept);
            self.lengths.extend(self.above[first..].iter().map(|&above| lengths[above as usize][lane]));
        } else {
            self.lengths.extend(self.hierarchy.ancestors(rank).map(|above| lengths[above as usize][lane]));
            self.lengths[start..].reverse();
        }
        self.starts.push(self.lengths.len());
    }
}

/// The first links as a forest in which what is above a vertex is its ancestors. Ranks are its postorder.
#[derive(Clone, Debug)]
struct Tree {
    depths: Vec<u32>,
    /// The lowest rank below each.
    lowest: Vec<u32>,
}

impl Tree {
    fn of(hierarchy: &Hierarchy) -> Self {
        let count = hierarchy.len() as u32;
        let mut tree = Self { depths: vec![0; count as usize], lowest: (0..count).collect() };
        let is_plain = |rank: &u32| !hierarchy.is_attachment(*rank);
        for rank in (0..count).rev().filter(is_plain) {
            if let Some(parent) = hierarchy.parent(rank) {
                tree.depths[rank as usize] = tree.depths[parent as usize] + 1;
            }
        }
        for rank in (0..count).filter(is_plain) {
            if let Some(parent) = hierarchy.parent(rank) {
                let lowest = &mut tree.lowest;
                lowest[parent as usize] = lowest[parent as usize].min(lowest[rank as usize]);
            }
        }
        tree
    }

    #[inline]
    fn depth(&self, rank: u32) -> usize {
        self.depths[rank as usize] as usize
    }

    /// Whether `above` is `rank` or one of its ancestors.
    fn is_above(&self, above: u32, rank: u32) -> bool {
        self.lowest[above as usize] <= rank && rank <= above
    }
}

/// The lowest common ancestor of any two in an ascending list of ranks: the highest one between neighbours in the list
/// from the one to the other. Bender and Farach-Colton, <https://doi.org/10.1007/10719839_9>, look up such an extreme
/// in two runs of a power of two, and so does this.
#[derive(Clone, Debug)]
struct Tops {
    /// Row k has the highest of 2ᵏ tops from each on.
    rows: Vec<Vec<u32>>,
}

impl Tops {
    fn among(ranks: &[u32], hierarchy: &Hierarchy) -> Self {
        let top =
            |pair: &[u32]| hierarchy.ancestors(pair[0]).find(|&above| above >= pair[1]).unwrap_or(NO_TOP);
        let mut rows: Vec<Vec<u32>> = vec![ranks.windows(2).map(top).collect()];
        let mut run = 1;
        while let Some(last) = rows.last().filter(|last| last.len() > run) {
            let next = last.iter().zip(&last[run..]).map(|(&a, &b)| a.max(b)).collect();
            rows.push(next);
            run *= 2;
        }
        Self { rows }
    }

    /// The top of two different entries of the list, the lower one first.
    #[inline]
    fn between(&self, low: usize, high: usize) -> u32 {
        let row = (high - low).ilog2() as usize;
        self.rows[row][low].max(self.rows[row][high - (1 << row)])
    }
}

/// The sweeps of one batch of sources, compiled for every width of vector registers.
struct Batch<'a, 'h> {
    climb: &'a mut SharedClimb<'h>,
    sources: &'a [u32],
}

impl OverLanes for Batch<'_, '_> {
    #[inline(always)]
    fn run(self) {
        self.climb.run(self.sources);
    }
}

/// The distances of a few sources to all ranks above any of them.
struct SharedClimb<'h> {
    hierarchy: &'h Hierarchy,
    reached: Vec<u32>,
    /// Valid for what is reached.
    lengths: Vec<Lanes>,
    is_reached: Vec<bool>,
}

impl<'h> SharedClimb<'h> {
    fn new(hierarchy: &'h Hierarchy) -> Self {
        let count = hierarchy.len();
        Self {
            hierarchy,
            reached: Vec::new(),
            lengths: vec![UNREACHED; count],
            is_reached: vec![false; count],
        }
    }

    /// One sweep up and one down through what is above the sources.
    #[inline(always)]
    fn run(&mut self, sources: &[u32]) {
        for rank in self.reached.drain(..) {
            self.is_reached[rank as usize] = false;
            self.lengths[rank as usize] = UNREACHED;
        }
        for (lane, &rank) in sources.iter().enumerate() {
            let (is_reached, reached) = (&mut self.is_reached, &mut self.reached);
            self.hierarchy.climb(rank, |above| {
                let is_new = !is_reached[above as usize];
                if is_new {
                    is_reached[above as usize] = true;
                    reached.push(above);
                }
                is_new
            });
            self.lengths[rank as usize][lane] = 0.0;
        }
        self.reached.sort_unstable();
        for &rank in &self.reached {
            let here = self.lengths[rank as usize];
            let (to, weights) = self.hierarchy.links(rank);
            for (&next, &weight) in to.iter().zip(weights) {
                lower(&mut self.lengths[next as usize], &here, weight);
            }
        }
        for &rank in self.reached.iter().rev() {
            let mut here = self.lengths[rank as usize];
            let (to, weights) = self.hierarchy.links(rank);
            for (&next, &weight) in to.iter().zip(weights) {
                lower(&mut here, &self.lengths[next as usize], weight);
            }
            self.lengths[rank as usize] = here;
        }
    }
}
