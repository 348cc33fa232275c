//! Cholesky factors of narrow symmetric bands.

/// A symmetric matrix with nothing beyond a band along its diagonal, and its factor.
///
/// A row is its last `width` entries up to the diagonal. Rows of zeros stand before the first, so that all rows are
/// alike, and with the width known to the compiler every row is straight-line code: a tenth of the instructions of a
/// sparse solver, whose pattern has to be looked up.
#[derive(Debug, Default)]
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

    /// Adds to an entry on or below the diagonal and within the band.
    #[inline]
    pub(crate) fn add(&mut self, row: usize, column: usize, value: f64) {
        let place = self.place(row, column);
        self.rows[place] += value;
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
            // Also if it is not a number.
            if !(square > 0.0) {
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
