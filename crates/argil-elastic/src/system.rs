//! The banded symmetric system of one Newton step.

use glam::{DMat2, DVec2};

use crate::band::Band;
use crate::rod::Rod;

/// Two unknowns for every free vertex; coupled are vertices one and two steps apart on the same free run.
///
/// Runs stand one after the other, so that a vertex is coupled with the two before it. If the whole cycle is free,
/// its first vertices are coupled with its last: it is then folded, one vertex from the one side after one from
/// the other, and the band is twice as wide.
#[derive(Clone, Debug, Default)]
pub(crate) struct NormalSystem {
    /// Where each free vertex stands in a folded system; empty if it is not folded.
    folded: Vec<usize>,
    matrix: Band,
    pub(crate) gradient: Vec<DVec2>,
}

impl NormalSystem {
    /// A system of zeros for the free vertices of a rod.
    pub(crate) fn start(&mut self, rod: &Rod) {
        let blocks = rod.free.len();
        self.folded.clear();
        if blocks == rod.len() {
            self.folded
                .extend((0..blocks).map(|b| if 2 * b < blocks { 2 * b } else { 2 * (blocks - b) - 1 }));
        }
        self.matrix.start(2 * blocks, !self.folded.is_empty());
        self.gradient.clear();
        self.gradient.resize(blocks, DVec2::ZERO);
    }

    pub(crate) fn clear(&mut self) {
        self.matrix.clear();
        self.gradient.fill(DVec2::ZERO);
    }

    #[inline]
    fn place(&self, b: usize) -> usize {
        self.folded.get(b).copied().unwrap_or(b)
    }

    /// Adds a symmetric block to the diagonal of free vertex `b`.
    #[inline]
    pub(crate) fn add_own(&mut self, b: usize, block: DMat2) {
        let row = 2 * self.place(b);
        self.matrix.add_on(row, block);
    }

    /// Adds a block whose rows belong to free vertex `a` and whose columns to free vertex `b`, with its mirror image.
    #[inline]
    pub(crate) fn add_coupling(&mut self, a: usize, b: usize, block: DMat2) {
        let (a, b) = (2 * self.place(a), 2 * self.place(b));
        if a > b {
            self.matrix.add_below(a, b, block);
        } else {
            self.matrix.add_below(b, a, block.transpose());
        }
    }

    /// Mean of the diagonal entries of free vertex `b`: how stiffly it is held.
    pub(crate) fn stiffness(&self, b: usize) -> f64 {
        let row = 2 * self.place(b);
        0.5 * (self.matrix.diagonal(row) + self.matrix.diagonal(row + 1))
    }

    /// The whole symmetric matrix, in the order of the free vertices.
    #[cfg(test)]
    pub(crate) fn dense(&self) -> nalgebra::DMatrix<f64> {
        let place = |k: usize| 2 * self.place(k / 2) + k % 2;
        let size = 2 * self.gradient.len();
        nalgebra::DMatrix::from_fn(size, size, |a, b| {
            let (a, b) = (place(a), place(b));
            self.matrix.entry(a.max(b), a.min(b))
        })
    }

    /// Solves for the Newton step; `false` if the matrix is not positive definite or the step not finite.
    ///
    /// `damping` goes onto the diagonal. Linear in the number of free vertices, and free of allocation.
    pub(crate) fn solve(&mut self, step: &mut [DVec2], damping: impl Fn(usize) -> f64) -> bool {
        let unknowns = self.matrix.unknowns();
        for (b, gradient) in self.gradient.iter().enumerate() {
            let row = 2 * self.folded.get(b).copied().unwrap_or(b);
            (unknowns[row], unknowns[row + 1]) = (-gradient.x, -gradient.y);
        }
        let solved = if self.folded.is_empty() {
            self.matrix.solve(|row| damping(row / 2))
        } else {
            let blocks = self.folded.len();
            // Back from the place to the vertex.
            let vertex =
                |place: usize| if place.is_multiple_of(2) { place / 2 } else { blocks - place.div_ceil(2) };
            self.matrix.solve(|row| damping(vertex(row / 2)))
        };
        if !solved {
            return false;
        }
        let unknowns = self.matrix.unknowns();
        for (b, out) in step.iter_mut().enumerate() {
            let row = 2 * self.folded.get(b).copied().unwrap_or(b);
            *out = DVec2::new(unknowns[row], unknowns[row + 1]);
        }
        step.iter().all(|s| s.is_finite())
    }
}
