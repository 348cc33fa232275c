//! A uniform grid over a set of points, for those near a segment.

use crate::Segment;
use glam::DVec2;

/// Coordinates beyond this are left out: their squares overflow.
const LARGEST: f64 = 1e150;

/// Cells allowed for each point: more would be empty.
const CELLS_PER_POINT: usize = 4;

/// A set of points in a uniform grid: built once, then asked often.
///
/// The points of a row of cells lie side by side in memory. Queries allocate nothing. Points with a coordinate that is not finite (or
/// beyond 1e150) are never found.
///
/// # Example
/// ```
/// use argil_curve::{DVec2, PointIndex, Segment};
/// let points: Vec<DVec2> = (0..10).map(|k| DVec2::new(f64::from(k), 0.0)).collect();
/// let index = PointIndex::new(&points, 1.0);
/// let rail = Segment::new(DVec2::new(2.0, 0.5), DVec2::new(4.0, 0.5));
/// let mut found = Vec::new();
/// index.for_each_within(rail, 0.5, |k| found.push(k));
/// assert_eq!(found, [2, 3, 4]);
/// ```
#[derive(Clone, Debug)]
pub struct PointIndex {
    origin: DVec2,
    cell: f64,
    columns: usize,
    rows: usize,
    /// Points of cell c are those from `offsets[c]` up to `offsets[c + 1]`.
    offsets: Vec<u32>,
    points: Vec<DVec2>,
    /// Index of each among the points as they were given.
    indices: Vec<u32>,
}

impl PointIndex {
    /// An index over `points` with square cells of side `cell` mm; half the usual query radius or a little more serves best. The side
    /// grows where the grid would have more than four cells a point.
    ///
    /// # Complexity
    /// O(n).
    #[must_use]
    pub fn new(points: &[DVec2], cell: f64) -> Self {
        let known = || points.iter().enumerate().filter(|(_, p)| p.abs().max_element() <= LARGEST);
        let (mut low, mut high, mut count) = (DVec2::INFINITY, DVec2::NEG_INFINITY, 0);
        for (_, &p) in known() {
            (low, high, count) = (low.min(p), high.max(p), count + 1);
        }
        if count == 0 {
            (low, high) = (DVec2::ZERO, DVec2::ZERO);
        }
        let extent = high - low;
        let most = (CELLS_PER_POINT * count + 1) as f64;
        let wanted = if cell > 0.0 && cell.is_finite() { cell } else { 0.0 };
        let mut cell = wanted.max(extent.max_element() / most).max(f64::MIN_POSITIVE);
        let cells = |cell: f64| (extent / cell).floor() + DVec2::ONE;
        while cells(cell).element_product() > most {
            cell *= 1.25;
        }
        let (columns, rows) = (cells(cell).x as usize, cells(cell).y as usize);
        let cell_of = |p: DVec2| {
            let at = (p - low) / cell;
            (at.y as usize).min(rows - 1) * columns + (at.x as usize).min(columns - 1)
        };
        let mut offsets = vec![0_u32; columns * rows + 1];
        known().for_each(|(_, &p)| offsets[cell_of(p) + 1] += 1);
        for k in 1..offsets.len() {
            offsets[k] += offsets[k - 1];
        }
        let mut next = offsets.clone();
        let (mut sorted, mut indices) = (vec![DVec2::ZERO; count], vec![0_u32; count]);
        for (k, &p) in known() {
            let slot = &mut next[cell_of(p)];
            (sorted[*slot as usize], indices[*slot as usize]) = (p, k as u32);
            *slot += 1;
        }
        Self { origin: low, cell, columns, rows, offsets, points: sorted, indices }
    }

    /// Visits the index of every point within `radius` mm of the segment, in an order that depends on nothing but the points, the cell
    /// and the query. Nothing is within a radius that is negative or not a number, or of a segment that is not finite.
    ///
    /// # Complexity
    /// O(points in the cells about the segment's box), without allocation.
    #[inline]
    pub fn for_each_within(&self, segment: Segment, radius: f64, mut visit: impl FnMut(usize)) {
        let (low, high) = (segment.start.min(segment.end), segment.start.max(segment.end));
        // Rounding loses no point of a cell next to the box.
        let slack = 1e-9 * self.cell
            + 1e-12 * (low.abs().max(high.abs()).max_element() + self.origin.abs().max_element());
        let (from, to) = (low - self.origin - radius - slack, high - self.origin + radius + slack);
        let size = DVec2::new(self.columns as f64, self.rows as f64) * self.cell;
        let meets = to.x >= 0.0 && to.y >= 0.0 && from.x <= size.x + slack && from.y <= size.y + slack;
        if !(meets && radius >= 0.0 && segment.start.is_finite() && segment.end.is_finite()) {
            return;
        }
        // Casts saturate, so what lies before the grid begins at its first cell.
        let column = |x: f64| ((x / self.cell) as usize).min(self.columns - 1);
        let row = |y: f64| ((y / self.cell) as usize).min(self.rows - 1);
        let (west, east) = (column(from.x), column(to.x));
        let along = segment.end - segment.start;
        let squared = along.length_squared();
        let share = if squared > 0.0 { 1.0 / squared } else { 0.0 };
        let reach = radius * radius;
        for row in row(from.y)..=row(to.y) {
            let first = self.offsets[row * self.columns + west] as usize;
            let last = self.offsets[row * self.columns + east + 1] as usize;
            for (&p, &index) in self.points[first..last].iter().zip(&self.indices[first..last]) {
                let away = p - segment.start;
                let t = (away.dot(along) * share).clamp(0.0, 1.0);
                if (away - t * along).length_squared() <= reach {
                    visit(index as usize);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn empty_and_odd_sets_answer_nothing() {
        let all = |points: &[DVec2], cell: f64| {
            let mut found = Vec::new();
            PointIndex::new(points, cell)
                .for_each_within(Segment::new(DVec2::ZERO, DVec2::ZERO), 1e9, |k| found.push(k));
            found
        };
        assert_eq!(all(&[], 1.0), []);
        assert_eq!(all(&[DVec2::NAN, DVec2::new(1e200, 0.0), DVec2::ONE], f64::NAN), [2]);
        assert_eq!(all(&[DVec2::ONE; 3], 1e-300), [0, 1, 2]);
    }

    #[test]
    fn odd_questions_have_no_answer() {
        let index = PointIndex::new(&[DVec2::ZERO], 1.0);
        let point = |x: f64| Segment::new(DVec2::new(x, 0.0), DVec2::new(x, 0.0));
        for (segment, radius) in
            [(point(0.0), -1.0), (point(0.0), f64::NAN), (point(f64::NAN), 1.0), (point(9.0), 1.0)]
        {
            index.for_each_within(segment, radius, |k| panic!("{k} found within {radius} of {segment:?}"));
        }
    }
}
