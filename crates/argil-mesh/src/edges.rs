/// The undirected edges of a mesh.
///
/// Edges are numbered in the order of their lower, then higher vertex, so that the numbering
/// depends on the mesh alone.
///
/// # Example
/// ```
/// use argil_mesh::{EdgeTable, Mesh};
/// let table: EdgeTable = Mesh::cuboid([0.0; 3], [1.0, 1.0, 1.0])?.edges();
/// assert_eq!(table.ends().len(), 18); // twelve of the box, and a diagonal a side
/// assert!(table.triangle_counts().iter().all(|&count| count == 2));
/// let [first, ..] = table.of_triangles()[0];
/// assert!(table.ends()[first as usize][0] < table.ends()[first as usize][1]);
/// # Ok::<(), argil_mesh::MeshError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EdgeTable {
    ends: Vec<[u32; 2]>,
    of_triangle: Vec<[u32; 3]>,
}

impl EdgeTable {
    /// Sorts the half-edges into buckets by their lower vertex; no hashing.
    pub(crate) fn new(vertex_count: usize, triangles: &[[u32; 3]]) -> Self {
        let half_edges = |corners: &[u32; 3]| {
            [[corners[0], corners[1]], [corners[1], corners[2]], [corners[2], corners[0]]]
                .map(|[a, b]| [a.min(b), a.max(b)])
        };
        let mut bucket = vec![0_usize; vertex_count + 1];
        for ends in triangles.iter().flat_map(half_edges) {
            bucket[ends[0] as usize + 1] += 1;
        }
        for k in 1..bucket.len() {
            bucket[k] += bucket[k - 1];
        }
        // (higher vertex, half-edge), grouped by lower vertex
        let mut sorted = vec![(0_u32, 0_u32); 3 * triangles.len()];
        let mut filled = bucket.clone();
        for (half, ends) in triangles.iter().flat_map(half_edges).enumerate() {
            let place = &mut filled[ends[0] as usize];
            sorted[*place] = (ends[1], half as u32);
            *place += 1;
        }
        let mut ends = Vec::with_capacity(sorted.len() / 2 + 1);
        let mut of_triangle = vec![[0_u32; 3]; triangles.len()];
        for low in 0..vertex_count {
            let group = &mut sorted[bucket[low]..bucket[low + 1]];
            group.sort_unstable();
            let mut last = None;
            for &(high, half) in group.iter() {
                if last != Some(high) {
                    last = Some(high);
                    ends.push([low as u32, high]);
                }
                of_triangle[half as usize / 3][half as usize % 3] = ends.len() as u32 - 1;
            }
        }
        Self { ends, of_triangle }
    }

    /// The two vertices of each edge, the lower index first.
    #[must_use]
    pub fn ends(&self) -> &[[u32; 2]] {
        &self.ends
    }

    /// How many triangles each edge has: two everywhere in a closed mesh.
    #[must_use]
    pub fn triangle_counts(&self) -> Vec<u32> {
        let mut counts = vec![0; self.ends.len()];
        self.of_triangle.iter().flatten().for_each(|&edge| counts[edge as usize] += 1);
        counts
    }

    /// The three edges of each triangle: number k runs from its corner k to its corner k + 1.
    #[must_use]
    pub fn of_triangles(&self) -> &[[u32; 3]] {
        &self.of_triangle
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_triangles_share_one_edge() {
        let table = EdgeTable::new(4, &[[0, 1, 2], [2, 1, 3]]);
        assert_eq!(table.ends(), [[0, 1], [0, 2], [1, 2], [1, 3], [2, 3]]);
        assert_eq!(table.of_triangles(), [[0, 2, 1], [2, 3, 4]]);
        assert_eq!(table.triangle_counts(), [1, 1, 2, 1, 1]);
    }
}
