use crate::Places;
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
    /// How many vertices became one with another that was not quite in their place.
    pub(crate) moved: usize,
    /// Triangles that had fewer than three different corners, and are left out.
    pub(crate) degenerate: Places,
}

/// Indices must be valid, and the coordinates of the vertices that triangles use finite. Vertices keep
/// their order, so that the same input always gives the same indices.
pub(crate) fn weld(vertices: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) -> Welded {
    let (vertices, mut triangles) = compact(vertices, triangles);
    let size = Bounds::of(&vertices).size();
    let diagonal = size.iter().map(|extent| extent * extent).sum::<f64>().sqrt();
    let mut pool = Pool::new(TOLERANCE * diagonal);
    let names: Vec<u32> = vertices.into_iter().map(|vertex| pool.take(vertex)).collect();
    let mut degenerate = Places::default();
    triangles.retain_mut(|corners| {
        *corners = corners.map(|corner| names[corner as usize]);
        let is_triangle = corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0];
        if !is_triangle {
            degenerate.note(pool.vertices[corners[0] as usize]);
        }
        is_triangle
    });
    let (vertices, triangles) = compact(pool.vertices, triangles);
    Welded { vertices, triangles, moved: pool.moved, degenerate }
}

/// Drops the vertices that no triangle uses.
pub(crate) fn compact(
    mut vertices: Vec<[f64; 3]>,
    mut triangles: Vec<[u32; 3]>,
) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let mut names = vec![NONE; vertices.len()];
    for &corner in triangles.iter().flatten() {
        names[corner as usize] = 0;
    }
    let mut left = 0;
    for old in 0..vertices.len() {
        if names[old] != NONE {
            names[old] = left;
            vertices[left as usize] = vertices[old];
            left += 1;
        }
    }
    vertices.truncate(left as usize);
    for corner in triangles.iter_mut().flatten() {
        *corner = names[*corner as usize];
    }
    (vertices, triangles)
}

/// The vertices kept so far, found again by cell. The map is only ever asked, never iterated, so
/// its order cannot show.
struct Pool {
    tolerance: f64,
    vertices: Vec<[f64; 3]>,
    /// The vertex met before in the same cell.
    previous: Vec<u32>,
    newest: HashMap<[i64; 3], u32>,
    moved: usize,
}

impl Pool {
    fn new(tolerance: f64) -> Self {
        Self { tolerance, vertices: Vec::new(), previous: Vec::new(), newest: HashMap::new(), moved: 0 }
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
            self.moved += usize::from(best.0 > 0.0);
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
            vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-0.0, -0.0, 0.0], [1.0, 1.0, 0.0]];
        let welded = weld(vertices, vec![[0, 1, 2], [3, 4, 2]]);
        assert_eq!(welded.vertices.len(), 4);
        assert_eq!(welded.triangles[1][0], welded.triangles[0][0]);
    }

    #[test]
    fn vertices_on_both_sides_of_a_cell_border_are_welded() {
        let border = 100.0 * CELL * TOLERANCE * 2.0_f64.sqrt();
        let near = [[border - 1e-8, 0.0, 0.0], [border + 1e-8, 0.0, 0.0]];
        let vertices = vec![near[0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], near[1], [0.0, 0.0, 0.0]];
        assert_eq!(weld(vertices, vec![[0, 1, 2], [3, 2, 4]]).vertices.len(), 4);
    }

    #[test]
    fn vertices_that_nothing_uses_do_not_count() {
        let vertices = vec![[f64::INFINITY; 3], [0.0; 3], [f64::NAN; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let welded = weld(vertices, vec![[1, 3, 4]]);
        assert_eq!((welded.vertices.len(), welded.triangles), (3, vec![[0, 1, 2]]));
    }
}
