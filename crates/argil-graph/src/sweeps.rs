//! All distances among some vertices by sweeps up and down the hierarchy.

use crate::hierarchy::Hierarchy;
use crate::{DistanceMatrix, PathGraph};

/// How many sources a sweep carries side by side. With fewer the links are read more often, with more the sweep
/// climbs through vertices that few of its sources need; 8 to 32 were equally fast on graphs of 900 to 5,300
/// vertices, and 16 lengths fill half of the vector registers of the plainest x86-64.
const LANES: usize = 16;

/// The distances of one vertex from the sources of a sweep.
type Lanes = [f64; LANES];

const UNREACHED: Lanes = [f64::INFINITY; LANES];

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
    /// all, even itself.
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
    pub fn distances(&self, among: &[u32]) -> DistanceMatrix {
        let hierarchy = self.hierarchy();
        let mut matrix = DistanceMatrix::unreached(among.len());
        // Where each distinct vertex is first mentioned, in the order of rank.
        let mut mentions: Vec<(u32, usize)> =
            among.iter().enumerate().filter_map(|(k, &v)| Some((hierarchy.rank(v)?, k))).collect();
        mentions.sort_unstable();
        let mut sources = mentions.clone();
        sources.dedup_by_key(|mention| mention.0);

        let mut sweep = Sweep::new(hierarchy, &sources);
        for batch in (0..sources.len()).step_by(LANES) {
            sweep.run(&sources[batch..sources.len().min(batch + LANES)]);
            sweep.collect(&sources[batch..], &mut matrix);
        }
        self.join_neighbouring_attachments(&sources, &mut matrix);
        for (at, mention) in mentions.iter().enumerate() {
            let first = mentions[..at].partition_point(|earlier| earlier.0 < mention.0);
            if first < at {
                matrix.duplicate(mentions[first].1, mention.1);
            }
        }
        matrix
    }

    /// A path between attachments that passes through none of them can be a single edge, which is no part of
    /// the hierarchy.
    fn join_neighbouring_attachments(&self, sources: &[(u32, usize)], matrix: &mut DistanceMatrix) {
        let hierarchy = self.hierarchy();
        let mention = |v: u32| {
            let rank = hierarchy.rank(v)?;
            let at = sources.binary_search_by_key(&rank, |source| source.0).ok()?;
            Some(sources[at].1)
        };
        for &(rank, k) in sources {
            let vertex = hierarchy.vertex(rank);
            if !self.is_attachment(vertex) {
                break; // attachments have the lowest ranks
            }
            for (other, weight) in self.neighbours(vertex).filter(|&(u, _)| self.is_attachment(u)) {
                if let Some(j) = mention(other) {
                    matrix.set(k, j, matrix.get(k, j).min(weight));
                }
            }
        }
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
    fn new(hierarchy: &'h Hierarchy, sources: &[(u32, usize)]) -> Self {
        let mut batch_of = vec![0; hierarchy.len()];
        for &(rank, _) in sources {
            hierarchy.climb(rank, |r| std::mem::replace(&mut batch_of[r as usize], 1) == 0);
        }
        let needed = (0..hierarchy.len() as u32).filter(|&r| batch_of[r as usize] == 1).collect();
        Sweep { hierarchy, needed, batch_of, batch: 1, lengths: vec![UNREACHED; hierarchy.len()] }
    }

    /// Computes the distances of at most as many sources as there are lanes to all ranks that are needed and
    /// not below the first source.
    ///
    /// Ranks below are left to earlier batches: a distance is the same in both directions.
    fn run(&mut self, sources: &[(u32, usize)]) {
        let Some(&(lowest, _)) = sources.first() else { return };
        self.batch += 1;
        let batch = self.batch;
        for (lane, &(rank, _)) in sources.iter().enumerate() {
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

    /// Copies the distances of the batch that was run, which `sources` begins with, to all later sources.
    fn collect(&self, sources: &[(u32, usize)], matrix: &mut DistanceMatrix) {
        for (later, &(rank, k)) in sources.iter().enumerate() {
            let lengths = &self.lengths[rank as usize];
            for (&(_, j), &length) in sources[..later.min(LANES)].iter().zip(lengths) {
                matrix.set(j, k, length);
            }
            matrix.set(k, k, 0.0);
        }
    }
}

/// Lowers the lengths in `here` to those by way of a vertex with the lengths `there`.
#[inline(always)]
fn lower(here: &mut Lanes, there: &Lanes, weight: f64) {
    for (a, b) in here.iter_mut().zip(there) {
        let through = b + weight;
        // Not `f64::min`: its rule for NaN, which cannot occur here, costs three more instructions.
        *a = if through < *a { through } else { *a };
    }
}
