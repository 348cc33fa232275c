//! The sparse symmetric system of one Newton step.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{Conj, MatMut, Par, Side};
use glam::{DMat2, DVec2};

use crate::ElasticError;
use crate::rod::Rod;

/// Two unknowns for every free vertex; coupled are vertices one and two steps apart on the same free run.
///
/// The pattern is block penta-diagonal along each run (with two corner blocks if the whole cycle is free), so the
/// natural order already gives a Cholesky factor without fill to speak of. Only the upper triangle is kept: faer's
/// identity ordering is usable with that one alone. Pattern and symbolic factor are made once per path.
pub(crate) struct NormalSystem {
    pattern: SymbolicSparseColMat<usize>,
    values: Vec<f64>,
    /// Where the diagonal entries are in `values`.
    diagonal: Vec<usize>,
    /// The diagonal without damping.
    undamped: Vec<f64>,
    pub(crate) gradient: Vec<DVec2>,
    symbolic: SymbolicCholesky<usize>,
    factor: Vec<f64>,
    right_side: Vec<f64>,
    memory: MemBuffer,
}

impl NormalSystem {
    pub(crate) fn new(rod: &Rod) -> Result<Self, ElasticError> {
        let blocks = rod.free.len();
        let too_large = ElasticError::SystemTooLarge { unknowns: 2 * blocks };
        let mut column_starts = Vec::with_capacity(2 * blocks + 1);
        let mut rows = Vec::with_capacity(11 * blocks);
        let mut diagonal = Vec::with_capacity(2 * blocks);
        column_starts.push(0);
        for (b, &vertex) in rod.free.iter().enumerate() {
            let mut above = coupled(rod, vertex as usize).map(|other| other.filter(|&a| a < b).unwrap_or(b));
            above.sort_unstable();
            for side in 0..2 {
                let mut last = b;
                for &a in above.iter().take_while(|&&a| a < b) {
                    if a != last {
                        rows.extend([2 * a, 2 * a + 1]);
                        last = a;
                    }
                }
                rows.extend(2 * b..=2 * b + side);
                diagonal.push(rows.len() - 1);
                column_starts.push(rows.len());
            }
        }
        let pattern = SymbolicSparseColMat::new_checked(2 * blocks, 2 * blocks, column_starts, None, rows);
        let parameters = CholeskySymbolicParams {
            // Supernodes pay off with dense blocks only, and the widest row here has ten entries.
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SIMPLICIAL,
            ..Default::default()
        };
        let symbolic = factorize_symbolic_cholesky(
            pattern.as_ref(),
            Side::Upper,
            SymmetricOrdering::Identity,
            parameters,
        )
        .map_err(|_| too_large)?;
        let scratch = symbolic
            .factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default())
            .or(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq));
        Ok(Self {
            values: vec![0.0; pattern.row_idx().len()],
            diagonal,
            undamped: Vec::with_capacity(2 * blocks),
            gradient: vec![DVec2::ZERO; blocks],
            factor: vec![0.0; symbolic.len_val()],
            right_side: vec![0.0; 2 * blocks],
            memory: MemBuffer::try_new(scratch).map_err(|_| too_large)?,
            pattern,
            symbolic,
        })
    }

    pub(crate) fn clear(&mut self) {
        self.values.fill(0.0);
        self.gradient.fill(DVec2::ZERO);
    }

    /// Adds a symmetric block to the diagonal of free vertex `b`.
    pub(crate) fn add_own(&mut self, b: usize, block: DMat2) {
        let (left, right) = (self.diagonal[2 * b], self.diagonal[2 * b + 1]);
        self.values[left] += block.x_axis.x;
        self.values[right - 1] += block.y_axis.x;
        self.values[right] += block.y_axis.y;
    }

    /// Adds a block whose rows belong to free vertex `a` and whose columns to free vertex `b`, with its mirror image.
    pub(crate) fn add_coupling(&mut self, a: usize, b: usize, block: DMat2) {
        let (upper, column, block) = if a < b { (a, b, block) } else { (b, a, block.transpose()) };
        for (side, entries) in [block.x_axis, block.y_axis].into_iter().enumerate() {
            let start = self.pattern.col_ptr()[2 * column + side];
            let end = self.diagonal[2 * column + side];
            let rows = &self.pattern.row_idx()[start..end];
            if let Some(place) = rows.iter().position(|&row| row == 2 * upper) {
                self.values[start + place] += entries.x;
                self.values[start + place + 1] += entries.y;
            }
        }
    }

    /// Mean of the diagonal entries of free vertex `b`: how stiffly it is held.
    pub(crate) fn stiffness(&self, b: usize) -> f64 {
        0.5 * (self.undamped[2 * b] + self.undamped[2 * b + 1])
    }

    /// Remembers the diagonal of the assembled matrix, to which every solve adds its damping.
    pub(crate) fn close(&mut self) {
        self.undamped.clear();
        self.undamped.extend(self.diagonal.iter().map(|&place| self.values[place]));
    }

    /// The whole symmetric matrix.
    #[cfg(test)]
    pub(crate) fn dense(&self) -> nalgebra::DMatrix<f64> {
        let size = self.diagonal.len();
        let mut dense = nalgebra::DMatrix::zeros(size, size);
        for column in 0..size {
            for place in self.pattern.col_ptr()[column]..self.pattern.col_ptr()[column + 1] {
                let row = self.pattern.row_idx()[place];
                dense[(row, column)] = self.values[place];
                dense[(column, row)] = self.values[place];
            }
        }
        dense
    }

    /// Solves for the Newton step; `false` if the matrix is not positive definite or the step not finite.
    ///
    /// Linear in the number of free vertices, and free of allocation.
    pub(crate) fn solve(&mut self, step: &mut [DVec2], damping: impl Fn(usize) -> f64) -> bool {
        for (k, (&place, undamped)) in self.diagonal.iter().zip(&self.undamped).enumerate() {
            self.values[place] = undamped + damping(k / 2);
        }
        for (pair, gradient) in self.right_side.chunks_exact_mut(2).zip(&self.gradient) {
            pair[0] = -gradient.x;
            pair[1] = -gradient.y;
        }
        let stack = MemStack::new(&mut self.memory);
        let matrix = SparseColMatRef::new(self.pattern.as_ref(), &self.values);
        let factored = self.symbolic.factorize_numeric_llt(
            &mut self.factor,
            matrix,
            Side::Upper,
            Default::default(),
            Par::Seq,
            stack,
            Default::default(),
        );
        let Ok(factor) = factored else { return false };
        let unknowns = self.right_side.len();
        let right_side = MatMut::from_column_major_slice_mut(&mut self.right_side, unknowns, 1);
        factor.solve_in_place_with_conj(Conj::No, right_side, Par::Seq, stack);
        for (out, pair) in step.iter_mut().zip(self.right_side.chunks_exact(2)) {
            *out = DVec2::new(pair[0], pair[1]);
        }
        step.iter().all(|s| s.is_finite())
    }
}

/// The free vertices, by number, that share a term of the energy with `vertex`.
fn coupled(rod: &Rod, vertex: usize) -> [Option<usize>; 4] {
    let number = |v: usize| rod.is_free(v).then(|| rod.number[v] as usize);
    let (before, after) = (rod.previous(vertex), rod.next(vertex));
    // Two steps away only across a free vertex: only there is the turn an energy.
    [
        number(before),
        number(before).and_then(|_| number(rod.previous(before))),
        number(after),
        number(after).and_then(|_| number(rod.next(after))),
    ]
}
