/// The place of a vertex that does not exist.
pub(crate) const NOWHERE: u32 = u32::MAX;

/// Shortest path lengths between all pairs of a list of vertices; symmetric.
///
/// # Example
/// ```
/// use argil_graph::{DVec2, DistanceMatrix, PathGraph};
/// let places = [(0.0, 0.0), (3.0, 0.0), (3.0, 4.0)].map(DVec2::from).to_vec();
/// let graph = PathGraph::from_edges(places, &[], &[], &[(0, 1, 3.0), (1, 2, 4.0)])?;
/// let distances: DistanceMatrix = graph.distances(&[2, 0]);
/// assert_eq!(distances.row(0), [0.0, 7.0]);
/// assert_eq!(distances.get(0, 9), f64::INFINITY);
/// assert!(distances.len() == 2 && !distances.is_empty());
/// # Ok::<(), argil_graph::GraphError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DistanceMatrix {
    count: usize,
    lengths: Vec<f64>,
}

impl DistanceMatrix {
    /// Makes it as large as a list of so many needs, with zeros from each to itself; what else is in it has still to be set.
    pub(crate) fn resize(&mut self, count: usize) {
        self.count = count;
        self.lengths.resize(count * count, 0.0);
        self.lengths.iter_mut().step_by(count + 1).for_each(|own| *own = 0.0);
    }

    /// Sets the length between two entries of the list, which must exist, in both directions.
    #[inline]
    pub(crate) fn set(&mut self, i: usize, j: usize, length: f64) {
        self.lengths[i * self.count + j] = length;
        self.lengths[j * self.count + i] = length;
    }

    /// Sets the lengths from the entry `i` to the entries from `j` on.
    #[inline(always)]
    pub(crate) fn set_run(&mut self, i: usize, j: usize, lengths: &[f64]) {
        let start = i * self.count + j;
        self.lengths[start..start + lengths.len()].copy_from_slice(lengths);
    }

    /// Sets the lengths from the entry `i` to the entries from `j` on, as far as there are any.
    #[inline(always)]
    pub(crate) fn set_each(&mut self, i: usize, j: usize, lengths: impl Iterator<Item = f64>) {
        let row = &mut self.lengths[i * self.count..(i + 1) * self.count];
        for (entry, length) in row.iter_mut().skip(j).zip(lengths) {
            *entry = length;
        }
    }

    /// Makes it the matrix of a list whose entries are, in this order, the entries `places` of this one's; what is
    /// [`NOWHERE`] is infinitely far from all, even itself.
    pub(crate) fn renumber(&mut self, places: &[u32]) {
        if places.len() == self.count && places.iter().zip(0..).all(|(&place, k)| place == k) {
            return;
        }
        let mut lengths = Vec::with_capacity(places.len() * places.len());
        for &from in places {
            let row = self.row(from as usize);
            lengths.extend(places.iter().map(|&to| row.get(to as usize).copied().unwrap_or(f64::INFINITY)));
        }
        *self = Self { count: places.len(), lengths };
    }

    /// How many vertices the list had.
    #[inline]
    #[must_use]
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether the list was empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The length of a shortest path from the vertex with index `i` in the list to the one with index `j`:
    /// infinite when there is none, and when an index is out of range.
    #[inline]
    #[must_use]
    pub fn get(&self, i: usize, j: usize) -> f64 {
        self.row(i).get(j).copied().unwrap_or(f64::INFINITY)
    }

    /// The lengths from the vertex with index `i` to all; empty when the index is out of range.
    #[inline]
    #[must_use]
    pub fn row(&self, i: usize) -> &[f64] {
        if i < self.count { &self.lengths[i * self.count..(i + 1) * self.count] } else { &[] }
    }
}
