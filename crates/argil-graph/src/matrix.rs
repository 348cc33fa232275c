/// Shortest path lengths between all pairs of a list of vertices; symmetric.
#[derive(Clone, Debug, PartialEq)]
pub struct DistanceMatrix {
    count: usize,
    lengths: Vec<f64>,
}

impl DistanceMatrix {
    pub(crate) fn from_rows(count: usize, lengths: Vec<f64>) -> DistanceMatrix {
        debug_assert_eq!(lengths.len(), count * count);
        DistanceMatrix { count, lengths }
    }

    /// How many vertices the list had.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether the list was empty.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The length of a shortest path from the vertex with index `i` in the list to the one with index `j`:
    /// infinite when there is none, and when an index is out of range.
    pub fn get(&self, i: usize, j: usize) -> f64 {
        self.row(i).get(j).copied().unwrap_or(f64::INFINITY)
    }

    /// The lengths from the vertex with index `i` to all; empty when the index is out of range.
    pub fn row(&self, i: usize) -> &[f64] {
        if i < self.count { &self.lengths[i * self.count..(i + 1) * self.count] } else { &[] }
    }
}
