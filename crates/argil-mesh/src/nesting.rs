//! Whether one shell lies inside another.

use crate::mesh::Bounds;
use crate::normal::{length, normal};

/// The most samples of one shell that are looked for in another: a part that sticks out of it is met if the shell has one triangle in so
/// many there.
const MOST_SAMPLES: usize = 4096;

/// The most samples of all shells that are looked for at once, shared among them.
const MOST_AT_ONCE: usize = 1 << 16;

/// How far inside its own shell a sample lies, as a share of the shell's extent: a cavity that touches the body's surface from
/// within has its samples in the body all the same, and one that reaches out of it has not.
const DEPTH: f64 = 1e-5;

/// Triangles of a mesh that belong together.
pub(crate) struct Shell<'a> {
    pub(crate) vertices: &'a [[f64; 3]],
    pub(crate) triangles: &'a [[u32; 3]],
    /// Indices of its triangles.
    pub(crate) members: &'a [u32],
    pub(crate) bounds: Bounds,
    /// Signed: it tells which side of a triangle is the shell's inside.
    pub(crate) volume: f64,
}

impl Shell<'_> {
    /// Points just inside, below triangles that are spread over the shell.
    fn samples(&self, most: usize) -> impl Iterator<Item = [f64; 3]> + '_ {
        let extent = self.bounds.size().iter().fold(0.0, |a: f64, &b| a.max(b));
        let depth = -DEPTH * extent * self.volume.signum();
        let count = self.members.len().min(most.max(1));
        (0..count).filter_map(move |k| {
            let mut corners = self.triangles[self.members[k * self.members.len() / count] as usize];
            let [a, b, c] = corners.map(|k| self.vertices[k as usize]);
            let normal = normal(a, b, c);
            let length = length(normal);
            (length > 0.0).then(|| {
                // Not the very middle, since grids have other edges in line with it; the same for both windings.
                corners.sort_unstable();
                let [a, b, c] = corners.map(|k| self.vertices[k as usize]);
                [0, 1, 2].map(|axis| {
                    0.35 * a[axis] + 0.34 * b[axis] + 0.31 * c[axis] + depth * normal[axis] / length
                })
            })
        })
    }
}

/// Whether each of the candidates lies inside `outer`: all samples of it do.
///
/// A point is inside where the shell is crossed a net number of times on the way out, both ways along x. The
/// crossings are found by cutting triangles at the height of the point: neighbours agree, to the bit, on where their common
/// edge is cut.
///
/// # Complexity
/// For each triangle of `outer`, a binary search and the samples at its heights.
pub(crate) fn is_inside(outer: &Shell<'_>, candidates: &[Shell<'_>]) -> Vec<bool> {
    let most = (MOST_AT_ONCE / candidates.len().max(1)).clamp(1, MOST_SAMPLES);
    let mut samples: Vec<Sample> = Vec::new();
    for (candidate, shell) in candidates.iter().enumerate() {
        samples.extend(shell.samples(most).map(|at| Sample { at, candidate, after: 0, before: 0 }));
    }
    samples.sort_by(|a, b| a.at[2].total_cmp(&b.at[2]));
    for &member in outer.members {
        let corners = outer.triangles[member as usize];
        let heights = corners.map(|k| outer.vertices[k as usize][2]);
        let low = heights.iter().copied().fold(f64::INFINITY, f64::min);
        let high = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let first = samples.partition_point(|sample| sample.at[2] < low);
        for sample in samples[first..].iter_mut().take_while(|sample| sample.at[2] <= high) {
            sample.meet(corners, outer.vertices);
        }
    }
    let mut inside = vec![false; candidates.len()];
    samples.iter().for_each(|sample| inside[sample.candidate] = true);
    for sample in samples.iter().filter(|sample| sample.after == 0 || sample.before == 0) {
        inside[sample.candidate] = false;
    }
    inside
}

struct Sample {
    at: [f64; 3],
    candidate: usize,
    /// Net crossings of the shell at greater x.
    after: i32,
    /// Net crossings at lesser x.
    before: i32,
}

impl Sample {
    fn meet(&mut self, corners: [u32; 3], vertices: &[[f64; 3]]) {
        let [x, y, z] = self.at;
        // Where the triangle's boundary comes down through the plane, and where it goes up; a corner in the plane is above it.
        let (mut down, mut up) = (None, None);
        for side in 0..3 {
            let (from, to) = (corners[side], corners[(side + 1) % 3]);
            let is_above = [from, to].map(|k| vertices[k as usize][2] >= z);
            match is_above {
                [true, false] => down = Some(cut(from.min(to), from.max(to), z, vertices)),
                [false, true] => up = Some(cut(from.min(to), from.max(to), z, vertices)),
                _ => {}
            }
        }
        let (Some(down), Some(up)) = (down, up) else { return };
        let sign = match (down[1] > y, up[1] > y) {
            (false, true) => 1,
            (true, false) => -1,
            _ => return,
        };
        // The two differ, so that there is a point between them.
        let t = (y - down[1]) / (up[1] - down[1]);
        if down[0] + t * (up[0] - down[0]) > x { self.after += sign } else { self.before += sign }
    }
}

/// X and y where an edge is cut at a height between those of its ends; the same for both directions.
fn cut(low: u32, high: u32, z: f64, vertices: &[[f64; 3]]) -> [f64; 2] {
    let [a, b] = [low, high].map(|k| vertices[k as usize]);
    let t = (z - a[2]) / (b[2] - a[2]);
    [0, 1].map(|axis| a[axis] + t * (b[axis] - a[axis]))
}
