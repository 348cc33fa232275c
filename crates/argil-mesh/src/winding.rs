use crate::EdgeTable;
use crate::normal::{length, normal};

const NONE: u32 = u32::MAX;

/// Triangles in patches: joined by edges that just two of them share.
pub(crate) struct Wound {
    pub(crate) triangles: Vec<[u32; 3]>,
    /// The patch of each triangle.
    pub(crate) patches: Vec<u32>,
    pub(crate) patch_count: usize,
    /// The triangles that were turned over.
    pub(crate) turned: Vec<u32>,
}

/// The triangles with windings that agree over every edge that just two of them share; in each
/// patch joined by such edges the side of more area keeps its winding.
///
/// A patch that cannot be wound consistently (a Möbius strip) keeps a seam where it disagrees;
/// the slicer meets it as a gap and reports it.
pub(crate) fn agreeing(vertices: &[[f64; 3]], triangles: &[[u32; 3]], edges: &EdgeTable) -> Wound {
    let neighbours = neighbours(edges);
    let mut wound = triangles.to_vec();
    let mut patches = vec![NONE; triangles.len()];
    let mut patch_count = 0;
    let mut turned_over = Vec::new();
    let mut turned: Vec<Option<bool>> = vec![None; triangles.len()];
    let mut patch = Vec::new();
    for first in 0..triangles.len() {
        if turned[first].is_some() {
            continue;
        }
        turned[first] = Some(false);
        patch.clear();
        patch.push(first);
        let mut done = 0;
        let mut area = [0.0; 2];
        while let Some(&triangle) = patch.get(done) {
            done += 1;
            let is_turned = turned[triangle] == Some(true);
            area[usize::from(is_turned)] += doubled_area(vertices, triangles[triangle]);
            // By number, since the order of the sides changes when a triangle is turned over, and a patch that cannot be wound
            // consistently is to have its seam where it had it.
            let mut sides = edges.of_triangles()[triangle];
            sides.sort_unstable();
            for edge in sides {
                let [a, b] = neighbours[edge as usize];
                let other = if a == triangle as u32 { b } else { a };
                if other == NONE || turned[other as usize].is_some() {
                    continue;
                }
                let agrees = runs_up_over(triangles, edges, triangle as u32, edge)
                    != runs_up_over(triangles, edges, other, edge);
                turned[other as usize] = Some(is_turned == agrees);
                patch.push(other as usize);
            }
        }
        let keep_turned = area[1] > area[0];
        for &triangle in &patch {
            patches[triangle] = patch_count as u32;
            if turned[triangle] != Some(keep_turned) {
                wound[triangle].swap(1, 2);
                turned_over.push(triangle as u32);
            }
        }
        patch_count += 1;
    }
    turned_over.sort_unstable();
    Wound { triangles: wound, patches, patch_count, turned: turned_over }
}

/// The two triangles of each edge; both NONE where one or more than two meet, since there no
/// winding can be told from a neighbour's.
fn neighbours(edges: &EdgeTable) -> Vec<[u32; 2]> {
    let mut count = vec![0_u32; edges.ends().len()];
    let mut pairs = vec![[NONE; 2]; edges.ends().len()];
    for (triangle, sides) in edges.of_triangles().iter().enumerate() {
        for &edge in sides {
            if let Some(slot) = pairs[edge as usize].get_mut(count[edge as usize] as usize) {
                *slot = triangle as u32;
            }
            count[edge as usize] += 1;
        }
    }
    for (pair, &met) in pairs.iter_mut().zip(&count) {
        if met != 2 {
            *pair = [NONE; 2];
        }
    }
    pairs
}

/// Whether the triangle runs along its side from the lower to the higher vertex index.
fn runs_up(corners: [u32; 3], side: usize) -> bool {
    corners[side] < corners[(side + 1) % 3]
}

fn runs_up_over(triangles: &[[u32; 3]], edges: &EdgeTable, triangle: u32, edge: u32) -> bool {
    let side = edges.of_triangles()[triangle as usize].iter().position(|&other| other == edge);
    runs_up(triangles[triangle as usize], side.unwrap_or(0))
}

fn doubled_area(vertices: &[[f64; 3]], corners: [u32; 3]) -> f64 {
    let [a, b, c] = corners.map(|k| vertices[k as usize]);
    length(normal(a, b, c))
}
