/// Shortest path lengths between all pairs of a list of vertices; symmetric.
#[derive(Clone, Debug, PartialEq)]
pub struct DistanceMatrix {
    count: usize,
    lengths: Vec<f64>,
}

impl DistanceMatrix {
    /// A matrix in which nothing is reached from anywhere.
    pub(crate) fn unreached(count: usize) -> DistanceMatrix {
        DistanceMatrix { count, lengths: vec![f64::INFINITY; count * count] }
    }

    /// Sets the length between two entries of the list, which must exist, in both directions.
    #[inline]
    pub(crate) fn set(&mut self, i: usize, j: usize, length: f64) {
        self.lengths[i * self.count + j] = length;
        self.lengths[j * self.count + i] = length;
    }

    /// Makes the entry `copy` of the list the same as the entry `original`.
    pub(crate) fn duplicate(&mut self, original: usize, copy: usize) {
        for k in 0..self.count {
            let length = self.get(original, k);
            self.set(copy, k, length);
        }
        self.set(copy, original, 0.0);
        self.set(copy, copy, 0.0);
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
