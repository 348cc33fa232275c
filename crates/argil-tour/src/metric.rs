//! What a tour is measured by.

/// A symmetric distance between nodes numbered `0 .. nodes()`.
///
/// The trait asks for no coordinates and no triangle inequality, so that the length of the shortest path round
/// an obstacle serves as well as the straight line. Distances must be finite, not negative, the same in both
/// directions and the same at every call. Where an implementation breaks this, the tour is still a permutation
/// of the nodes, but its length means little.
///
/// The solver asks for one distance at a time, several hundred thousand times a tour: store what is dear to
/// compute, for instance in a [`MatrixMetric`]. Where that would take too much memory, from thousands of nodes on, the
/// solver remembers what it asked last, and distances may be made on demand.
pub trait Metric {
    /// How many nodes there are.
    fn nodes(&self) -> usize;

    /// The distance between nodes `a` and `b`, both below [`nodes`](Self::nodes).
    fn distance(&self, a: usize, b: usize) -> f64;

    /// The distances from node `a` to all nodes in their order, where they lie in memory like this. Nearest nodes are then
    /// looked for several distances at a time.
    #[inline]
    fn row(&self, a: usize) -> Option<&[f64]> {
        let _ = a;
        None
    }
}

impl<M: Metric + ?Sized> Metric for &M {
    fn nodes(&self) -> usize {
        (**self).nodes()
    }

    fn distance(&self, a: usize, b: usize) -> f64 {
        (**self).distance(a, b)
    }

    fn row(&self, a: usize) -> Option<&[f64]> {
        (**self).row(a)
    }
}

/// A metric stored as a full matrix, row by row.
///
/// # Example
/// ```
/// use argil_tour::{MatrixMetric, Metric, TourError};
///
/// let metric = MatrixMetric::new(2, &[0.0, 3.5, 3.5, 0.0])?;
/// assert_eq!(metric.distance(1, 0), 3.5);
///
/// let lopsided = MatrixMetric::new(2, &[0.0, 3.5, 3.0, 0.0]);
/// assert!(matches!(lopsided, Err(TourError::Asymmetric { row: 0, column: 1, .. })));
/// # Ok::<(), TourError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MatrixMetric<'a> {
    nodes: usize,
    entries: &'a [f64],
}

impl<'a> MatrixMetric<'a> {
    /// Reads `entries` as the distances between `nodes` nodes: entry `a * nodes + b` is that from `a` to `b`.
    ///
    /// # Errors
    /// [`TourError::NotSquare`] if there are not `nodes * nodes` entries; [`TourError::NotADistance`] at the first
    /// entry that is negative or not finite; [`TourError::Asymmetric`] at the first pair that differs between
    /// its two directions. Symmetry is exact: a matrix that is symmetric up to rounding should be made so by its
    /// maker, for the local search balances gains that an asymmetry of any size could make circular.
    ///
    /// # Complexity
    /// Two passes over the matrix.
    pub fn new(nodes: usize, entries: &'a [f64]) -> Result<Self, TourError> {
        if nodes.checked_mul(nodes) != Some(entries.len()) {
            return Err(TourError::NotSquare { nodes, entries: entries.len() });
        }
        if let Some(k) = entries.iter().position(|value| !(value.is_finite() && *value >= 0.0)) {
            return Err(TourError::NotADistance { row: k / nodes, column: k % nodes, value: entries[k] });
        }
        for row in 0..nodes {
            for column in row + 1..nodes {
                let (value, mirrored) = (entries[row * nodes + column], entries[column * nodes + row]);
                if value != mirrored {
                    return Err(TourError::Asymmetric { row, column, value, mirrored });
                }
            }
        }
        Ok(Self { nodes, entries })
    }
}

impl Metric for MatrixMetric<'_> {
    fn nodes(&self) -> usize {
        self.nodes
    }

    #[inline]
    fn distance(&self, a: usize, b: usize) -> f64 {
        self.entries[a * self.nodes + b]
    }

    fn row(&self, a: usize) -> Option<&[f64]> {
        Some(&self.entries[a * self.nodes..(a + 1) * self.nodes])
    }
}

/// Why a matrix is no metric.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TourError {
    /// The number of entries is not the square of the number of nodes.
    #[error("{nodes} nodes need a matrix of {nodes} × {nodes} distances, not of {entries} entries")]
    NotSquare {
        /// The number of nodes that was claimed.
        nodes: usize,
        /// The number of entries that came.
        entries: usize,
    },
    /// An entry is negative, infinite or not a number.
    #[error("the distance from node {row} to node {column} is {value}, which is negative or not finite")]
    NotADistance {
        /// The node the distance is from.
        row: usize,
        /// The node the distance is to.
        column: usize,
        /// The entry.
        value: f64,
    },
    /// A distance differs between its two directions.
    #[error("node {row} is {value} from node {column}, but {mirrored} the other way round")]
    Asymmetric {
        /// The node the first distance is from.
        row: usize,
        /// The node the first distance is to.
        column: usize,
        /// The distance from `row` to `column`.
        value: f64,
        /// The distance from `column` to `row`.
        mirrored: f64,
    },
}
