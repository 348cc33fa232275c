use crate::mesh::Bounds;
use std::collections::HashMap;

/// Vertices closer than this fraction of the mesh's diagonal are one vertex. Single precision, in
/// which STL stores coordinates, resolves 6e-8 of the size: a tenth of it would miss vertices
/// that an exporter computed twice, ten times as much would close real gaps of 0.001 mm in a
/// part of 100 mm.
const TOLERANCE: f64 = 1e-6;

/// Cells are this many tolerances wide, so that the box of one tolerance about a point seldom
/// reaches a second cell, while a cell still holds a handful of vertices at most.
const CELL: f64 = 256.0;

const NONE: u32 = u32::MAX;

pub(crate) struct Welded {
    pub(crate) vertices: Vec<[f64; 3]>,
    pub(crate) triangles: Vec<[u32; 3]>,
}

/// Welds in the order of first use, so that the same triangles always give the same indices.
/// Indices must be valid and coordinates finite.
pub(crate) fn weld(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Welded {
    let size = Bounds::of(vertices).size();
    let diagonal = size.iter().map(|extent| extent * extent).sum::<f64>().sqrt();
    let mut pool = Pool::new(TOLERANCE * diagonal);
    let mut renamed = vec![NONE; vertices.len()];
    let mut kept = Vec::with_capacity(triangles.len());
    for corners in triangles {
        let corners = corners.map(|corner| {
            let name = &mut renamed[corner as usize];
            if *name == NONE {
                *name = pool.take(vertices[corner as usize]);
            }
            *name
        });
        if corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0] {
            kept.push(corners);
        }
    }
    compact(pool.vertices, kept)
}

/// Drops the vertices that only degenerate triangles used.
fn compact(vertices: Vec<[f64; 3]>, mut triangles: Vec<[u32; 3]>) -> Welded {
    let mut used = vec![false; vertices.len()];
    for &corner in triangles.iter().flatten() {
        used[corner as usize] = true;
    }
    if used.iter().all(|&is_used| is_used) {
        return Welded { vertices, triangles };
    }
    let mut renamed = vec![NONE; vertices.len()];
    let mut left = Vec::with_capacity(vertices.len());
    for (old, vertex) in vertices.into_iter().enumerate() {
        if used[old] {
            renamed[old] = left.len() as u32;
            left.push(vertex);
        }
    }
    for corner in triangles.iter_mut().flatten() {
        *corner = renamed[*corner as usize];
    }
    Welded { vertices: left, triangles }
}

/// The vertices kept so far, found again by cell. The map is only ever asked, never iterated, so
/// its order cannot show.
struct Pool {
    tolerance: f64,
    vertices: Vec<[f64; 3]>,
    /// The vertex met before in the same cell.
    previous: Vec<u32>,
    newest: HashMap<[i64; 3], u32>,
}

impl Pool {
    fn new(tolerance: f64) -> Self {
        Self { tolerance, vertices: Vec::new(), previous: Vec::new(), newest: HashMap::new() }
    }

    /// The nearest kept vertex within the tolerance, or this point as a new one.
    fn take(&mut self, point: [f64; 3]) -> u32 {
        // A mesh of no size is one point: any cell width will do.
        let cell = if self.tolerance > 0.0 { CELL * self.tolerance } else { 1.0 };
        let cell_of = |value: f64| (value / cell).floor() as i64;
        let low = point.map(|value| cell_of(value - self.tolerance));
        let high = point.map(|value| cell_of(value + self.tolerance));
        let mut best = (self.tolerance * self.tolerance, NONE);
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                for z in low[2]..=high[2] {
                    let mut next = self.newest.get(&[x, y, z]).copied().unwrap_or(NONE);
                    while next != NONE {
                        let other = self.vertices[next as usize];
                        let gap: f64 = (0..3).map(|axis| (other[axis] - point[axis]).powi(2)).sum();
                        if gap < best.0 || (gap == best.0 && next < best.1) {
                            best = (gap, next);
                        }
                        next = self.previous[next as usize];
                    }
                }
            }
        }
        if best.1 != NONE {
            return best.1;
        }
        let index = self.vertices.len() as u32;
        self.vertices.push(point);
        let older = self.newest.insert(point.map(cell_of), index);
        self.previous.push(older.unwrap_or(NONE));
        index
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signed_zeros_are_one_vertex() {
        let vertices =
            [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-0.0, -0.0, 0.0], [1.0, 1.0, 0.0]];
        let welded = weld(&vertices, &[[0, 1, 2], [3, 4, 2]]);
        assert_eq!(welded.vertices.len(), 4);
        assert_eq!(welded.triangles[1][0], welded.triangles[0][0]);
    }

    #[test]
    fn vertices_on_both_sides_of_a_cell_border_are_welded() {
        let diagonal = 2.0_f64.sqrt();
        let cell = CELL * TOLERANCE * diagonal;
        let border = 100.0 * cell;
        let near = [[border - 1e-8, 0.0, 0.0], [border + 1e-8, 0.0, 0.0]];
        let vertices = [near[0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], near[1], [0.0, 0.0, 0.0]];
        assert_eq!(weld(&vertices, &[[0, 1, 2], [3, 2, 4]]).vertices.len(), 4);
    }
}
