//! Connected surfaces as wholes: which of them are inside out.

use crate::EdgeTable;
use crate::mesh::Bounds;
use crate::nesting::{Shell, is_inside};
use crate::normal::{length, normal};
use crate::winding::Wound;

/// A volume below this share of area times extent is that of a sheet, whose two sides cannot be told apart.
const FLAT: f64 = 1e-6;

/// The vector area of a closed surface is zero. Beyond this share of the area a surface is so open that it has no inside: a box
/// without one side has a fifth, half a sphere a half.
const OPEN: f64 = 0.4;

/// What was turned over.
pub(crate) struct Outward {
    /// How many shells there are.
    pub(crate) shells: usize,
    /// One triangle of each shell that was turned over for itself, its corners as indices.
    pub(crate) triangles: Vec<[u32; 3]>,
}

/// Turns over every shell that is inside out and lies in no other one, with all that lies inside it.
///
/// # Complexity
/// Linear in the triangles while all shells face outwards; otherwise each one that does not is compared with each larger one,
/// whose triangles are gone through once for all that may lie inside it.
pub(crate) fn turned_outwards(vertices: &[[f64; 3]], wound: &mut Wound, edges: &EdgeTable) -> Outward {
    let (of_patch, count) = shells_of_patches(wound, edges);
    let of_triangle: Vec<u32> = wound.patches.iter().map(|&patch| of_patch[patch as usize]).collect();
    let measured = measured(vertices, &wound.triangles, &of_triangle, count);
    let mut outward = Outward { shells: count, triangles: Vec::new() };
    let inside_out: Vec<usize> = (0..count).filter(|&shell| measured[shell].volume < 0.0).collect();
    if inside_out.is_empty() {
        return outward;
    }
    let lists = lists(&of_triangle, count);
    let shell = |index: usize| Shell {
        vertices,
        triangles: &wound.triangles,
        members: &lists[index],
        bounds: measured[index].bounds,
        volume: measured[index].volume,
    };
    let larger = |outer: usize, inner: usize| {
        measured[outer].volume.abs() > measured[inner].volume.abs() && measured[outer].holds(&measured[inner])
    };
    let mut is_root = vec![true; count];
    for outer in 0..count {
        let candidates: Vec<usize> =
            inside_out.iter().copied().filter(|&inner| is_root[inner] && larger(outer, inner)).collect();
        let inside = is_inside(&shell(outer), &candidates.iter().map(|&k| shell(k)).collect::<Vec<_>>());
        for (&inner, _) in candidates.iter().zip(inside).filter(|(_, inside)| *inside) {
            is_root[inner] = false;
        }
    }
    let roots: Vec<usize> = inside_out.into_iter().filter(|&shell| is_root[shell]).collect();
    let mut turns = vec![false; count];
    for &root in &roots {
        turns[root] = true;
        outward.triangles.push(wound.triangles[lists[root][0] as usize]);
        let candidates: Vec<usize> = (0..count).filter(|&inner| larger(root, inner)).collect();
        let inside = is_inside(&shell(root), &candidates.iter().map(|&k| shell(k)).collect::<Vec<_>>());
        for (&inner, _) in candidates.iter().zip(inside).filter(|(_, inside)| *inside) {
            turns[inner] = true;
        }
    }
    for (corners, &shell) in wound.triangles.iter_mut().zip(&of_triangle) {
        if turns[shell as usize] {
            corners.swap(1, 2);
        }
    }
    outward
}

/// The shell of each patch, and how many shells there are.
///
/// A patch that closes by itself is one shell, also where it touches another one in an edge. Patches that do not close but at
/// edges with more than two triangles belong together there.
fn shells_of_patches(wound: &Wound, edges: &EdgeTable) -> (Vec<u32>, usize) {
    let counts = edges.triangle_counts();
    // (edge, patch, +1 where a triangle runs up along it and −1 where it runs down)
    let mut uses: Vec<(u32, u32, i32)> = Vec::new();
    for (triangle, sides) in edges.of_triangles().iter().enumerate() {
        for &edge in sides.iter().filter(|&&edge| counts[edge as usize] > 2) {
            let corners = wound.triangles[triangle];
            let [low, high] = edges.ends()[edge as usize];
            let runs_up = (0..3).any(|k| corners[k] == low && corners[(k + 1) % 3] == high);
            uses.push((edge, wound.patches[triangle], if runs_up { 1 } else { -1 }));
        }
    }
    uses.sort_unstable();
    let mut parent: Vec<u32> = (0..wound.patch_count as u32).collect();
    for at_edge in uses.chunk_by(|a, b| a.0 == b.0) {
        let mut last = None;
        for of_patch in at_edge.chunk_by(|a, b| a.1 == b.1) {
            if of_patch.iter().map(|&(.., sign)| sign).sum::<i32>() == 0 {
                continue;
            }
            let root = root(&mut parent, of_patch[0].1);
            if let Some(other) = last.replace(root) {
                // The lower index leads, so that shells are numbered as the mesh is.
                let (low, high) = (root.min(other), root.max(other));
                parent[high as usize] = low;
                last = Some(low);
            }
        }
    }
    let mut names = vec![u32::MAX; wound.patch_count];
    let mut count = 0;
    let shells = (0..wound.patch_count as u32)
        .map(|patch| {
            let name = &mut names[root(&mut parent, patch) as usize];
            if *name == u32::MAX {
                *name = count;
                count += 1;
            }
            *name
        })
        .collect();
    (shells, count as usize)
}

fn root(parent: &mut [u32], patch: u32) -> u32 {
    let mut at = patch;
    while parent[at as usize] != at {
        parent[at as usize] = parent[parent[at as usize] as usize];
        at = parent[at as usize];
    }
    at
}

/// What is known of a shell without looking at others.
struct Measured {
    bounds: Bounds,
    /// Signed; 0 for a sheet, flat or curved.
    volume: f64,
}

impl Measured {
    /// Whether the box of another one lies in the box of this one.
    fn holds(&self, other: &Self) -> bool {
        (0..3).all(|axis| {
            self.bounds.min[axis] <= other.bounds.min[axis] && other.bounds.max[axis] <= self.bounds.max[axis]
        })
    }
}

/// Bounds and volume of each shell; the volume about the middle of its own box, so that shells with holes have one, too.
fn measured(
    vertices: &[[f64; 3]],
    triangles: &[[u32; 3]],
    of_triangle: &[u32],
    count: usize,
) -> Vec<Measured> {
    let mut bounds = vec![Bounds::of([]); count];
    for (corners, &shell) in triangles.iter().zip(of_triangle) {
        corners.iter().for_each(|&k| bounds[shell as usize].include(&vertices[k as usize]));
    }
    let mut sums = vec![Sums::default(); count];
    for (corners, &shell) in triangles.iter().zip(of_triangle) {
        let middle = bounds[shell as usize].centre();
        let [a, b, c] = corners.map(|k| [0, 1, 2].map(|axis| vertices[k as usize][axis] - middle[axis]));
        let normal = normal(a, b, c);
        let sums = &mut sums[shell as usize];
        sums.volume += (0..3).map(|axis| a[axis] * normal[axis]).sum::<f64>() / 6.0;
        sums.area += 0.5 * length(normal);
        (0..3).for_each(|axis| sums.vector[axis] += 0.5 * normal[axis]);
    }
    bounds
        .into_iter()
        .zip(sums)
        .map(|(bounds, Sums { volume, area, vector })| {
            let extent = bounds.size().iter().fold(0.0, |a: f64, &b| a.max(b));
            let is_sheet = volume.abs() <= FLAT * area * extent || length(vector) > OPEN * area;
            Measured { bounds, volume: if is_sheet { 0.0 } else { volume } }
        })
        .collect()
}

#[derive(Clone, Default)]
struct Sums {
    volume: f64,
    area: f64,
    /// The sum of the triangles' normals, each as long as its area.
    vector: [f64; 3],
}

/// The triangles of each shell.
fn lists(of_triangle: &[u32], count: usize) -> Vec<Vec<u32>> {
    let mut lists = vec![Vec::new(); count];
    for (triangle, &shell) in of_triangle.iter().enumerate() {
        lists[shell as usize].push(triangle as u32);
    }
    lists
}
