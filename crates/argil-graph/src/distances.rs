//! A matrix where there is room for one, and distances on demand where there is not.

use crate::{DistanceLabels, DistanceMatrix, PathGraph};

/// Shortest path lengths between all pairs of a list of vertices, stored in the one way or the other.
///
/// Both have the same lengths: to the bit when all weights are whole numbers, else up to the rounding of sums.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Distances<'g> {
    /// All of them, one after the other.
    Matrix(DistanceMatrix),
    /// Each when it is asked for.
    OnDemand(DistanceLabels<'g>),
}

impl PathGraph {
    /// A sensible limit for [`distances_within`](Self::distances_within), in bytes: 256 MB, a matrix of some 5,700
    /// vertices.
    pub const MOST_MATRIX_BYTES: usize = 256_000_000;

    /// The lengths of shortest paths between all pairs of the vertices `among`, as a matrix if that takes no more than
    /// `most_bytes`, and otherwise on demand. What decides is the length of the list alone.
    ///
    /// A matrix answers faster and is dearer to make: from some thousand vertices on, a search for a tour is sooner done
    /// without.
    ///
    /// # Complexity
    /// As [`distances`](Self::distances) and [`distances_on_demand`](Self::distances_on_demand).
    ///
    /// # Example
    /// ```
    /// use argil_graph::{Distances, PathGraph};
    /// use glam::dvec2;
    ///
    /// let row = (0..3).map(|k| dvec2(f64::from(k), 0.0)).collect();
    /// let graph = PathGraph::from_edges(row, &[], &[], &[(0, 1, 1.0), (1, 2, 1.0)])?;
    /// let ample = graph.distances_within(&[0, 1, 2], PathGraph::MOST_MATRIX_BYTES);
    /// let scant = graph.distances_within(&[0, 1, 2], 71); // nine lengths take 72 bytes
    /// assert!(matches!(ample, Distances::Matrix(_)) && matches!(scant, Distances::OnDemand(_)));
    /// assert_eq!((ample.get(0, 2), scant.get(0, 2)), (2.0, 2.0));
    /// # Ok::<(), argil_graph::GraphError>(())
    /// ```
    pub fn distances_within(&self, among: &[u32], most_bytes: usize) -> Distances<'_> {
        let bytes =
            among.len().checked_mul(among.len()).and_then(|entries| entries.checked_mul(size_of::<f64>()));
        if bytes.is_some_and(|bytes| bytes <= most_bytes) {
            Distances::Matrix(self.distances(among))
        } else {
            Distances::OnDemand(self.distances_on_demand(among))
        }
    }
}

impl Distances<'_> {
    /// How many vertices the list had.
    #[inline]
    pub fn len(&self) -> usize {
        match self {
            Self::Matrix(matrix) => matrix.len(),
            Self::OnDemand(labels) => labels.len(),
        }
    }

    /// Whether the list was empty.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The length of a shortest path from the vertex with index `i` in the list to the one with index `j`:
    /// infinite when there is none, and when an index is out of range.
    #[inline]
    pub fn get(&self, i: usize, j: usize) -> f64 {
        match self {
            Self::Matrix(matrix) => matrix.get(i, j),
            Self::OnDemand(labels) => labels.get(i, j),
        }
    }
}
