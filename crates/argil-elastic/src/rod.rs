//! The candidate as a discrete elastic rod: what stays the same while its vertices move.

use glam::DVec2;

use crate::Path;

/// Shortest edge that the energies distinguish from none, in w.
///
/// A shorter candidate edge would make Eq. 2 and Eq. 3 arbitrarily stiff: both divide by its length. The
/// millimetre value of the experiments, 1e-3 at w = 1.5, is ten times the output grid.
const SHORTEST_EDGE: f64 = 1e-3 / 1.5;

/// The number of a vertex that has no unknowns.
pub(crate) const FIXED: u32 = u32::MAX;

/// A closed chain of vertices and edges; edge k runs from vertex k to vertex k + 1. Lengths in w.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rod {
    /// Free vertices run by run, so that neighbours on the path are neighbours in the linear system.
    pub(crate) free: Vec<u32>,
    /// For every vertex its place in `free`, or [`FIXED`].
    pub(crate) number: Vec<u32>,
    /// Edges with at least one free end, ascending.
    pub(crate) edges: Vec<u32>,
    /// `L_k` of the candidate, floored so that nothing divides by zero.
    pub(crate) rest: Vec<f64>,
    /// Arc length of every vertex from vertex 0.
    pub(crate) arc: Vec<f64>,
    /// Length of the whole cycle.
    pub(crate) perimeter: f64,
}

impl Rod {
    /// Lays the rod along the candidate; `scaled` are the path's points in w.
    pub(crate) fn lay(&mut self, path: &Path<'_>, scaled: &[DVec2]) {
        let n = scaled.len();
        self.number.clear();
        self.number.resize(n, FIXED);
        self.free.clear();
        // Numbering begins behind a fixed vertex: no run of free vertices is then cut in two by vertex 0.
        let first = path.fixed.iter().position(|&fixed| fixed).unwrap_or(0);
        for v in (first..n).chain(0..first) {
            if !path.fixed[v] {
                self.number[v] = self.free.len() as u32;
                self.free.push(v as u32);
            }
        }
        self.rest.clear();
        self.arc.clear();
        self.edges.clear();
        self.perimeter = 0.0;
        for k in 0..n {
            let rest = scaled[k].distance(scaled[(k + 1) % n]).max(SHORTEST_EDGE);
            self.arc.push(self.perimeter);
            self.rest.push(rest);
            self.perimeter += rest;
            if self.edge_has_free_end(k) {
                self.edges.push(k as u32);
            }
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.number.len()
    }

    pub(crate) fn next(&self, v: usize) -> usize {
        if v + 1 == self.len() { 0 } else { v + 1 }
    }

    pub(crate) fn previous(&self, v: usize) -> usize {
        if v == 0 { self.len() - 1 } else { v - 1 }
    }

    pub(crate) fn is_free(&self, v: usize) -> bool {
        self.number[v] != FIXED
    }

    pub(crate) fn edge_has_free_end(&self, k: usize) -> bool {
        self.is_free(k) || self.is_free(self.next(k))
    }

    /// How many edges lie between edges `a` and `b`, the shorter way round.
    pub(crate) fn edges_apart(&self, a: usize, b: usize) -> usize {
        let gap = a.abs_diff(b);
        gap.min(self.len() - gap)
    }

    /// The part of edge `k` that lies more than `skip` of arc from vertex `v`, as a range of the edge's parameter.
    ///
    /// Exact on long wall edges too, where judging by the midpoint would let the foot of a strand be repelled by
    /// the very edge it stands on. Both ways round have to be long enough, and each cuts one end off the edge.
    pub(crate) fn part_beyond(&self, v: usize, k: usize, skip: f64) -> Option<(f64, f64)> {
        let mut ahead = self.arc[k] - self.arc[v];
        if ahead < 0.0 {
            ahead += self.perimeter;
        }
        let behind = self.perimeter - ahead - self.rest[k];
        if ahead + self.rest[k] <= skip || behind + self.rest[k] <= skip {
            return None;
        }
        let from = ((skip - ahead) / self.rest[k]).max(0.0);
        let to = 1.0 - ((skip - behind) / self.rest[k]).max(0.0);
        (from < to).then_some((from, to))
    }
}
