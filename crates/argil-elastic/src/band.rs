//! Cholesky factors of narrow symmetric bands.

use glam::DMat2;

/// A symmetric matrix with nothing beyond a band along its diagonal, and its factor.
///
/// A row is its last `width` entries up to the diagonal. Rows of zeros stand before the first, so that all rows are
/// alike, and with the width known to the compiler every row is straight-line code: a tenth of the instructions of a
/// sparse solver, whose pattern has to be looked up.
#[derive(Clone, Debug, Default)]
pub(crate) struct Band {
    width: usize,
    size: usize,
    /// The lower half without what is added to its diagonal.
    rows: Vec<f64>,
    factor: Vec<f64>,
    /// One over the diagonal of the factor.
    inverse: Vec<f64>,
    /// Right side, and then solution.
    unknowns: Vec<f64>,
}

/// Widths of the two kinds of band: a chain of blocks of two, each coupled with two before it, and a chain folded so
/// that its ends meet, where there are four before it.
pub(crate) const CHAIN: usize = 6;
pub(crate) const FOLDED: usize = 10;

impl Band {
    /// A matrix of zeros with `size` rows; the width is one of the two that there are.
    pub(crate) fn start(&mut self, size: usize, folded: bool) {
        self.width = if folded { FOLDED } else { CHAIN };
        self.size = size;
        let padded = size + self.width - 1;
        for (list, length) in [
            (&mut self.rows, padded * self.width),
            (&mut self.factor, padded * self.width),
            (&mut self.inverse, padded),
            (&mut self.unknowns, padded),
        ] {
            list.clear();
            list.resize(length, 0.0);
        }
    }

    pub(crate) fn clear(&mut self) {
        self.rows.fill(0.0);
    }

    fn place(&self, row: usize, column: usize) -> usize {
        // Row `width - 1` of those stored is row 0, and its last entry is on the diagonal.
        (row + self.width) * self.width - 1 - (row - column)
    }

    /// Adds a block of two columns and two rows, below the diagonal and within the band.
    #[inline]
    pub(crate) fn add_below(&mut self, row: usize, column: usize, block: DMat2) {
        let (upper, next) = (self.place(row, column), self.width - 1);
        let entries = &mut self.rows[upper..=upper + self.width];
        entries[0] += block.x_axis.x;
        entries[1] += block.y_axis.x;
        entries[next] += block.x_axis.y;
        entries[next + 1] += block.y_axis.y;
    }

    /// Adds a symmetric block on the diagonal, from this row on.
    #[inline]
    pub(crate) fn add_on(&mut self, row: usize, block: DMat2) {
        let (upper, next) = (self.place(row, row), self.width - 1);
        let entries = &mut self.rows[upper..=upper + self.width];
        entries[0] += block.x_axis.x;
        entries[next] += block.y_axis.x;
        entries[next + 1] += block.y_axis.y;
    }

    pub(crate) fn diagonal(&self, row: usize) -> f64 {
        self.rows[self.place(row, row)]
    }

    /// An entry on or below the diagonal; zero beyond the band.
    #[cfg(test)]
    pub(crate) fn entry(&self, row: usize, column: usize) -> f64 {
        if row - column < self.width { self.rows[self.place(row, column)] } else { 0.0 }
    }

    /// The right side of the next [`solve`](Self::solve), and the solution after it.
    pub(crate) fn unknowns(&mut self) -> &mut [f64] {
        &mut self.unknowns[self.width - 1..]
    }

    /// Solves for the unknowns with `added` on the diagonal of each row; `false`, and nothing meant by the unknowns, if the
    /// matrix is not positive definite.
    pub(crate) fn solve(&mut self, added: impl Fn(usize) -> f64) -> bool {
        if self.width == FOLDED { self.solve_with::<FOLDED>(added) } else { self.solve_with::<CHAIN>(added) }
    }

    fn solve_with<const WIDTH: usize>(&mut self, added: impl Fn(usize) -> f64) -> bool {
        let reach = WIDTH - 1;
        let (rows, _) = self.rows.as_chunks::<WIDTH>();
        let (factor, _) = self.factor.as_chunks_mut::<WIDTH>();
        let (inverse, x) = (&mut self.inverse, &mut self.unknowns);
        for i in reach..rows.len() {
            let mut row = rows[i];
            let before = &factor[i - reach..i];
            let scales = &inverse[i - reach..i];
            let mut square = row[reach] + added(i - reach);
            let mut sum = x[i];
            for c in 0..reach {
                let mut entry = row[c];
                for k in 0..c {
                    entry -= row[k] * before[c][reach - c + k];
                }
                entry *= scales[c];
                row[c] = entry;
                square -= entry * entry;
                sum -= entry * x[i - reach + c];
            }
            if square.is_nan() || square <= 0.0 {
                return false;
            }
            inverse[i] = 1.0 / square.sqrt();
            x[i] = sum * inverse[i];
            factor[i] = row;
        }
        for i in (reach..rows.len()).rev() {
            let value = x[i] * inverse[i];
            x[i] = value;
            let row = &factor[i];
            for (c, x) in x[i - reach..i].iter_mut().enumerate() {
                *x -= row[c] * value;
            }
        }
        true
    }
}
