//! All distances among some vertices by sweeps up and down the hierarchy.

use crate::hierarchy::Hierarchy;
use crate::matrix::NOWHERE;
use crate::vectors::{OverLanes, Vectors};
use crate::{DistanceMatrix, PathGraph};

/// How many sources a sweep carries side by side. With fewer the links are read more often, with more the sweep
/// climbs through vertices that few of its sources need; 8 to 32 were equally fast on graphs of 900 to 5,300
/// vertices, and 16 lengths fill half of the vector registers of the plainest x86-64.
pub(crate) const LANES: usize = 16;

/// The distances of one vertex from the sources of a sweep.
pub(crate) type Lanes = [f64; LANES];

pub(crate) const UNREACHED: Lanes = [f64::INFINITY; LANES];

impl PathGraph {
    /// The lengths of shortest paths between all pairs of the vertices `among`, infinite where there is no
    /// path. Paths never pass through an attachment.
    ///
    /// The paper's planner spends most of its time in one Dijkstra search for each pair (Sec. 3.3). Here the
    /// vertices are eliminated once, and every few sources share one sweep up and one down what that leaves.
    ///
    /// The lengths are exact: bit for bit when all weights are whole numbers and no length exceeds 2⁵³,
    /// otherwise up to the rounding of the sums, which are associated differently than along the path. The
    /// matrix is exactly symmetric with a zero diagonal. A vertex that does not exist is infinitely far from
    /// all, even itself. A list that [`arrange`](Self::arrange) has put in order saves a copy of the matrix.
    ///
    /// # Complexity
    /// For T vertices among V, and L links in the hierarchy (about V log V on plane graphs): O(T L), for
    /// mostly consecutive memory. The first call on a graph adds the elimination, see
    /// [`path`](PathGraph::path).
    ///
    /// # Example
    /// ```
    /// use argil_graph::PathGraph;
    /// use glam::dvec2;
    ///
    /// let corners = vec![dvec2(0.0, 0.0), dvec2(3.0, 0.0), dvec2(3.0, 4.0), dvec2(9.0, 9.0)];
    /// let graph = PathGraph::from_edges(corners, &[], &[], &[(0, 1, 3.0), (1, 2, 4.0)])?;
    /// let distances = graph.distances(&[2, 0, 3]);
    /// assert_eq!(distances.row(0), [0.0, 7.0, f64::INFINITY]);
    /// # Ok::<(), argil_graph::GraphError>(())
    /// ```
    #[must_use]
    pub fn distances(&self, among: &[u32]) -> DistanceMatrix {
        let mut matrix = DistanceMatrix::default();
        self.distances_into(among, &mut matrix);
        matrix
    }

    /// The same lengths into a matrix that is there already, whatever is in it, so that layer after layer uses the memory of one.
    ///
    /// Of a list that [`arrange`](Self::arrange) has put in order, and a matrix at least as large, nothing is allocated but what the sweeps
    /// need: about 130 bytes a vertex.
    ///
    /// # Complexity
    /// That of [`distances`](Self::distances), less the time in which the system gives memory out and wipes it.
    ///
    /// # Example
    /// ```
    /// use argil_graph::{DistanceMatrix, PathGraph};
    /// use glam::dvec2;
    ///
    /// let mut matrix = DistanceMatrix::default();
    /// for length in [1.0, 2.0] {
    ///     let row = vec![dvec2(0.0, 0.0), dvec2(length, 0.0)];
    ///     let graph = PathGraph::from_edges(row, &[], &[], &[(0, 1, length)])?;
    ///     graph.distances_into(&[0, 1], &mut matrix);
    ///     assert_eq!(matrix.row(0), [0.0, length]);
    /// }
    /// # Ok::<(), argil_graph::GraphError>(())
    /// ```
    pub fn distances_into(&self, among: &[u32], matrix: &mut DistanceMatrix) {
        let hierarchy = self.hierarchy();
        let Sources { ranks: sources, places } = Sources::of(hierarchy, among);
        matrix.resize(sources.len());
        let mut sweep = Sweep::new(hierarchy, &sources);
        let vectors = Vectors::here();
        for first in (0..sources.len()).step_by(LANES) {
            vectors.run(Batch { sweep: &mut sweep, sources: &sources, first, matrix });
        }
        self.join_neighbouring_attachments(&sources, matrix);
        matrix.renumber(&places);
    }

    /// Puts vertices into the order in which distances among them are found, so that [`distances`](Self::distances)
    /// need not move the matrix about. Neighbours in the plane are then mostly near each other in the list, and
    /// what reads the matrix finds more of it in the processor's cache. Vertices that do not exist go last.
    ///
    /// # Complexity
    /// O(T log T), and the elimination if this is the first search in the graph.
    ///
    /// # Example
    /// ```
    /// use argil_graph::PathGraph;
    /// use glam::dvec2;
    ///
    /// let row: Vec<_> = (0..5).map(|k| dvec2(f64::from(k), 0.0)).collect();
    /// let graph = PathGraph::from_edges(row, &[], &[], &[(0, 1, 1.0), (1, 2, 1.0), (2, 3, 1.0), (3, 4, 1.0)])?;
    /// let mut wanted = [4, 0, 2];
    /// graph.arrange(&mut wanted);
    /// let distances = graph.distances(&wanted);
    /// for (k, &v) in wanted.iter().enumerate() {
    ///     assert_eq!(distances.get(0, k), f64::from(wanted[0].abs_diff(v)));
    /// }
    /// # Ok::<(), argil_graph::GraphError>(())
    /// ```
    pub fn arrange(&self, vertices: &mut [u32]) {
        let hierarchy = self.hierarchy();
        vertices.sort_by_key(|&v| hierarchy.rank(v).unwrap_or(u32::MAX));
    }

    /// A path between attachments that passes through none of them can be a single edge, which is no part of
    /// the hierarchy.
    fn join_neighbouring_attachments(&self, sources: &[u32], matrix: &mut DistanceMatrix) {
        let hierarchy = self.hierarchy();
        for (k, &rank) in sources.iter().enumerate() {
            let vertex = hierarchy.vertex(rank);
            if !self.is_attachment(vertex) {
                break; // attachments have the lowest ranks
            }
            for (other, weight) in self.neighbours(vertex).filter(|&(u, _)| self.is_attachment(u)) {
                let place = hierarchy.rank(other).and_then(|rank| sources.binary_search(&rank).ok());
                if let Some(j) = place {
                    matrix.set(k, j, matrix.get(k, j).min(weight));
                }
            }
        }
    }
}

/// A list of vertices as searches see it.
pub(crate) struct Sources {
    /// The ranks of the distinct vertices, ascending.
    pub(crate) ranks: Vec<u32>,
    /// For each entry of the list its place among them, or [`NOWHERE`] for a vertex that does not exist.
    pub(crate) places: Vec<u32>,
}

impl Sources {
    pub(crate) fn of(hierarchy: &Hierarchy, among: &[u32]) -> Self {
        let mut mentions: Vec<(u32, usize)> =
            among.iter().enumerate().filter_map(|(k, &v)| Some((hierarchy.rank(v)?, k))).collect();
        mentions.sort_unstable();
        let mut places = vec![NOWHERE; among.len()];
        let mut ranks: Vec<u32> = Vec::with_capacity(mentions.len());
        for (rank, k) in mentions {
            if ranks.last() != Some(&rank) {
                ranks.push(rank);
            }
            places[k] = ranks.len() as u32 - 1;
        }
        Self { ranks, places }
    }
}

/// The sweeps of one batch of sources, compiled for every width of vector registers. The lengths are the same
/// with all of them: each is made by the same additions and comparisons.
struct Batch<'a, 'h> {
    sweep: &'a mut Sweep<'h>,
    sources: &'a [u32],
    /// The first source of the batch.
    first: usize,
    matrix: &'a mut DistanceMatrix,
}

impl OverLanes for Batch<'_, '_> {
    #[inline(always)]
    fn run(self) {
        let later = &self.sources[self.first..];
        self.sweep.run(&later[..later.len().min(LANES)]);
        self.sweep.collect(later, self.first, self.matrix);
    }
}

struct Sweep<'h> {
    hierarchy: &'h Hierarchy,
    /// All ranks above any source, ascending: no other can lie on the way between two sources.
    needed: Vec<u32>,
    /// The last batch whose sources the rank is above.
    batch_of: Vec<u32>,
    batch: u32,
    lengths: Vec<Lanes>,
}

impl<'h> Sweep<'h> {
    fn new(hierarchy: &'h Hierarchy, sources: &[u32]) -> Self {
        let mut batch_of = vec![0; hierarchy.len()];
        for &rank in sources {
            hierarchy.climb(rank, |r| std::mem::replace(&mut batch_of[r as usize], 1) == 0);
        }
        let needed = (0..hierarchy.len() as u32).filter(|&r| batch_of[r as usize] == 1).collect();
        Sweep { hierarchy, needed, batch_of, batch: 1, lengths: vec![UNREACHED; hierarchy.len()] }
    }

    /// Computes the distances of at most as many sources as there are lanes to all ranks that are needed and
    /// not below the first source.
    ///
    /// Ranks below are left to earlier batches: a distance is the same in both directions.
    #[inline(always)]
    fn run(&mut self, sources: &[u32]) {
        let Some(&lowest) = sources.first() else { return };
        self.batch += 1;
        let batch = self.batch;
        for (lane, &rank) in sources.iter().enumerate() {
            let (batch_of, lengths) = (&mut self.batch_of, &mut self.lengths);
            self.hierarchy.climb(rank, |r| {
                let is_new = batch_of[r as usize] != batch;
                if is_new {
                    batch_of[r as usize] = batch;
                    lengths[r as usize] = UNREACHED;
                }
                is_new
            });
            self.lengths[rank as usize][lane] = 0.0;
        }
        let needed = &self.needed[self.needed.partition_point(|&r| r < lowest)..];
        for &rank in needed.iter().filter(|&&r| self.batch_of[r as usize] == batch) {
            let here = self.lengths[rank as usize];
            let (to, weights) = self.hierarchy.links(rank);
            for (&next, &weight) in to.iter().zip(weights) {
                lower(&mut self.lengths[next as usize], &here, weight);
            }
        }
        for &rank in needed.iter().rev() {
            let mut here =
                if self.batch_of[rank as usize] == batch { self.lengths[rank as usize] } else { UNREACHED };
            let (to, weights) = self.hierarchy.links(rank);
            for (&next, &weight) in to.iter().zip(weights) {
                lower(&mut here, &self.lengths[next as usize], weight);
            }
            self.lengths[rank as usize] = here;
        }
    }

    /// Copies the distances from the batch that was run, which `later` begins with, to all of `later`, whose
    /// first is number `first` of the sources.
    #[inline(always)]
    fn collect(&self, later: &[u32], first: usize, matrix: &mut DistanceMatrix) {
        // Tiles of as many rows as columns, so that both a row and its mirror image are written in whole lines.
        for (tile, ranks) in later.chunks(LANES).enumerate() {
            let start = tile * LANES;
            for (k, &rank) in (start..).zip(ranks) {
                let lengths = &self.lengths[rank as usize];
                // Within the batch a source has its distances to the earlier ones only.
                matrix.set_run(first + k, first, if k < LANES { &lengths[..k] } else { lengths });
            }
            for lane in 0..LANES.min(later.len()) {
                let skipped = (lane + 1).saturating_sub(start);
                let run = ranks.iter().skip(skipped).map(|&rank| self.lengths[rank as usize][lane]);
                matrix.set_each(first + lane, first + start + skipped, run);
            }
        }
    }
}

/// Lowers the lengths in `here` to those by way of a vertex with the lengths `there`.
#[inline(always)]
pub(crate) fn lower(here: &mut Lanes, there: &Lanes, weight: f64) {
    for (a, b) in here.iter_mut().zip(there) {
        let through = b + weight;
        // Not `f64::min`: its rule for NaN, which cannot occur here, costs three more instructions.
        *a = if through < *a { through } else { *a };
    }
}
