use std::sync::OnceLock;

use glam::DVec2;
#[cfg(feature = "rayon")]
use rayon::prelude::*;

use crate::GraphError;
use crate::hierarchy::Hierarchy;

/// One thread weighs at least this many edges: fewer take less time than another thread takes to wake.
#[cfg(feature = "rayon")]
const EDGES_AT_ONCE: usize = 256;

/// A plane graph of paths between walls, with flat, index-ordered storage.
///
/// Vertices are numbered attachments first, then terminals, then everything else. Paths may begin and end at
/// an attachment and never pass through one: the route stage turns onto the wall there.
#[derive(Clone, Debug)]
pub struct PathGraph {
    positions: Vec<DVec2>,
    is_attachment: Vec<bool>,
    attachments: Vec<u32>,
    terminals: Vec<u32>,
    /// The neighbours of vertex `v` are `targets[offsets[v]..offsets[v + 1]]`, in ascending order.
    offsets: Vec<u32>,
    targets: Vec<u32>,
    weights: Vec<f64>,
    /// Made by the first search.
    hierarchy: OnceLock<Hierarchy>,
}

impl PathGraph {
    /// What [`attachment`](Self::attachment) and [`terminal`](Self::terminal) return for an index that does
    /// not exist. It is no vertex: it has no neighbours, and nothing reaches it.
    pub const NO_VERTEX: u32 = u32::MAX;

    /// A graph from explicit vertices and weighted undirected edges.
    ///
    /// `attachments` and `terminals` name vertices, in any order and number; `edges` are `(a, b, weight)`. Of
    /// several edges between the same two vertices the lightest counts. Positions are carried along and not
    /// looked at, save that they must be finite.
    ///
    /// # Errors
    /// Positions that are not finite, vertices that do not exist, edges from a vertex to itself, weights that
    /// are negative or not finite.
    ///
    /// # Complexity
    /// O(V + E log E).
    ///
    /// # Example
    /// ```
    /// use argil_graph::PathGraph;
    /// use glam::dvec2;
    ///
    /// let corners = vec![dvec2(0.0, 0.0), dvec2(1.0, 0.0), dvec2(1.0, 1.0)];
    /// let graph = PathGraph::from_edges(corners, &[], &[0, 2], &[(0, 1, 1.0), (1, 2, 1.0), (0, 2, 5.0)])?;
    /// assert_eq!(graph.path(0, 2), Some(vec![0, 1, 2]));
    /// assert_eq!(graph.paths_from(0, &[2, 7]), [Some(vec![0, 1, 2]), None]);
    /// assert_eq!((graph.vertex_count(), graph.edge_count(), graph.positions()[1]), (3, 3, dvec2(1.0, 0.0)));
    /// assert_eq!(graph.neighbours(0).collect::<Vec<_>>(), [(1, 1.0), (2, 5.0)]);
    /// // There is no attachment, and no third terminal.
    /// assert!(!graph.is_attachment(0) && graph.terminal(2) == PathGraph::NO_VERTEX);
    /// # Ok::<(), argil_graph::GraphError>(())
    /// ```
    pub fn from_edges(
        positions: Vec<DVec2>,
        attachments: &[u32],
        terminals: &[u32],
        edges: &[(u32, u32, f64)],
    ) -> Result<PathGraph, GraphError> {
        let count = positions.len();
        if count >= u32::MAX as usize || edges.len() > (u32::MAX / 2) as usize {
            return Err(GraphError::TooLarge { count: count.max(edges.len()) });
        }
        if let Some((index, &point)) = positions.iter().enumerate().find(|(_, p)| !p.is_finite()) {
            let (kind, limit) = (crate::PointKind::Vertex, f64::MAX);
            return Err(GraphError::Coordinate { kind, index, point, limit });
        }
        let ends = edges.iter().flat_map(|&(a, b, _)| [a, b]);
        let mut named = attachments.iter().chain(terminals).copied().chain(ends);
        if let Some(vertex) = named.find(|&v| v as usize >= count) {
            return Err(GraphError::NoSuchVertex { vertex, count });
        }
        for &(a, b, weight) in edges {
            if a == b {
                return Err(GraphError::LoopEdge { vertex: a });
            }
            check_weight(positions[a as usize], positions[b as usize], weight)?;
        }
        let mut sorted: Vec<(u32, u32, f64)> =
            edges.iter().map(|&(a, b, w)| (a.min(b), a.max(b), w)).collect();
        sorted.sort_unstable_by(|p, q| (p.0, p.1).cmp(&(q.0, q.1)).then(p.2.total_cmp(&q.2)));
        sorted.dedup_by_key(|edge| (edge.0, edge.1));
        let mut is_attachment = vec![false; count];
        for &v in attachments {
            is_attachment[v as usize] = true;
        }
        let (attachments, terminals) = (attachments.to_vec(), terminals.to_vec());
        Ok(PathGraph::assemble(positions, is_attachment, attachments, terminals, &sorted))
    }

    /// A graph whose first `attachment_count` vertices are the attachments, from distinct pairs `a < b` in
    /// ascending order.
    pub(crate) fn from_pairs(
        positions: Vec<DVec2>,
        attachment_count: u32,
        attachments: Vec<u32>,
        terminals: Vec<u32>,
        pairs: &[(u32, u32)],
        weight: impl Fn(DVec2, DVec2) -> f64 + Sync,
    ) -> Result<PathGraph, GraphError> {
        if pairs.len() > (u32::MAX / 2) as usize {
            return Err(GraphError::TooLarge { count: pairs.len() });
        }
        let ends = |&(a, b): &(u32, u32)| (positions[a as usize], positions[b as usize]);
        let weighed = |pair: &(u32, u32)| {
            let (from, to) = ends(pair);
            (pair.0, pair.1, weight(from, to))
        };
        #[cfg(feature = "rayon")]
        let edges: Vec<_> = pairs.par_iter().with_min_len(EDGES_AT_ONCE).map(weighed).collect();
        #[cfg(not(feature = "rayon"))]
        let edges: Vec<_> = pairs.iter().map(weighed).collect();
        for (pair, edge) in pairs.iter().zip(&edges) {
            let (from, to) = ends(pair);
            check_weight(from, to, edge.2)?;
        }
        let is_attachment = (0..positions.len()).map(|v| v < attachment_count as usize).collect();
        Ok(PathGraph::assemble(positions, is_attachment, attachments, terminals, &edges))
    }

    fn assemble(
        positions: Vec<DVec2>,
        is_attachment: Vec<bool>,
        attachments: Vec<u32>,
        terminals: Vec<u32>,
        edges: &[(u32, u32, f64)],
    ) -> PathGraph {
        let mut offsets = vec![0_u32; positions.len() + 1];
        for &(a, b, _) in edges {
            offsets[a as usize + 1] += 1;
            offsets[b as usize + 1] += 1;
        }
        for v in 0..positions.len() {
            offsets[v + 1] += offsets[v];
        }
        let mut next = offsets.clone();
        let mut targets = vec![0; 2 * edges.len()];
        let mut weights = vec![0.0; 2 * edges.len()];
        // The edges ascend by (a, b) with a < b. Placing first the lower neighbours of every vertex and then
        // the higher ones leaves each list sorted.
        let halves = edges.iter().map(|&(a, b, w)| (b, a, w)).chain(edges.iter().copied());
        for (from, to, w) in halves {
            let slot = next[from as usize] as usize;
            next[from as usize] += 1;
            (targets[slot], weights[slot]) = (to, w);
        }
        let hierarchy = OnceLock::new();
        PathGraph { positions, is_attachment, attachments, terminals, offsets, targets, weights, hierarchy }
    }

    pub(crate) fn hierarchy(&self) -> &Hierarchy {
        self.hierarchy.get_or_init(|| Hierarchy::new(self))
    }

    /// How many vertices there are; they are numbered from zero.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    /// Where the vertex is, in mm; not a number for a vertex that does not exist.
    #[must_use]
    pub fn position(&self, v: u32) -> DVec2 {
        self.positions.get(v as usize).copied().unwrap_or(DVec2::NAN)
    }

    /// The positions of all vertices, in mm.
    #[must_use]
    pub fn positions(&self) -> &[DVec2] {
        &self.positions
    }

    /// The vertex of the attachment with index `k` in the caller's list; equal attachments share one.
    /// [`NO_VERTEX`](Self::NO_VERTEX) when the list is shorter.
    #[must_use]
    pub fn attachment(&self, k: usize) -> u32 {
        self.attachments.get(k).copied().unwrap_or(Self::NO_VERTEX)
    }

    /// The vertex of the terminal with index `k` in the caller's list; equal terminals share one.
    /// [`NO_VERTEX`](Self::NO_VERTEX) when the list is shorter.
    #[must_use]
    pub fn terminal(&self, k: usize) -> u32 {
        self.terminals.get(k).copied().unwrap_or(Self::NO_VERTEX)
    }

    /// Whether paths may begin and end at the vertex but not pass through it.
    #[must_use]
    pub fn is_attachment(&self, v: u32) -> bool {
        self.is_attachment.get(v as usize).copied().unwrap_or(false)
    }

    /// How many undirected edges there are.
    #[must_use]
    pub fn edge_count(&self) -> usize {
        self.targets.len() / 2
    }

    /// Every edge once as `(a, b, weight)` with `a < b`, in ascending order of `(a, b)`.
    pub fn edges(&self) -> impl Iterator<Item = (u32, u32, f64)> + '_ {
        (0..self.positions.len() as u32)
            .flat_map(|v| self.neighbours(v).filter(move |&(u, _)| v < u).map(move |(u, w)| (v, u, w)))
    }

    /// The neighbours of a vertex in ascending order, each with the weight of the edge to it; none for a
    /// vertex that does not exist.
    pub fn neighbours(&self, v: u32) -> impl Iterator<Item = (u32, f64)> + '_ {
        let (targets, weights) = self.adjacency(v);
        targets.iter().copied().zip(weights.iter().copied())
    }

    /// The neighbours of a vertex and the weights of the edges to them, side by side.
    pub(crate) fn adjacency(&self, v: u32) -> (&[u32], &[f64]) {
        let v = v as usize;
        match (self.offsets.get(v), self.offsets.get(v.saturating_add(1))) {
            (Some(&start), Some(&end)) => {
                let slots = start as usize..end as usize;
                (&self.targets[slots.clone()], &self.weights[slots])
            }
            _ => (&[], &[]),
        }
    }
}

fn check_weight(from: DVec2, to: DVec2, weight: f64) -> Result<f64, GraphError> {
    if weight.is_finite() && weight >= 0.0 {
        // Adding zero turns a negative zero into a positive one.
        Ok(weight + 0.0)
    } else {
        Err(GraphError::Weight { from, to, weight })
    }
}
