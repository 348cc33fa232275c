//! A grid of points over a polygon, and which of them lie inside.

use argil_curve::{DVec2, Segment};

use crate::FillError;

/// A square grid over the box round a polygon, one point wider on every side, so that every point inside has eight neighbours.
#[derive(Clone, Debug)]
pub(crate) struct Plot {
    pub(crate) low: DVec2,
    pub(crate) step: f64,
    pub(crate) columns: usize,
    pub(crate) rows: usize,
    /// The points inside: row, first and last column, in order.
    pub(crate) runs: Vec<(usize, usize, usize)>,
}

/// More points than this are not held.
pub(crate) const MOST_POINTS: f64 = 67_108_864.0;

impl Plot {
    /// The points of a grid that lie inside of `sides` by the even-odd rule; `None` where there are none.
    ///
    /// # Errors
    /// [`FillError::TooLarge`]
    pub(crate) fn new(sides: &[Segment], step: f64) -> Result<Option<Self>, FillError> {
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for side in sides {
            (low, high) = (low.min(side.start), high.max(side.start));
        }
        if !(step > 0.0 && (high - low).is_finite() && (high - low).min_element() > 0.0) {
            return Ok(None);
        }
        let size = ((high - low) / step).ceil() + 3.0;
        if size.element_product() > MOST_POINTS {
            return Err(FillError::TooLarge { points: size.element_product(), limit: MOST_POINTS });
        }
        let (columns, rows) = (size.x as usize, size.y as usize);
        let mut plot = Self { low: low - 0.5 * step, step, columns, rows, runs: Vec::new() };
        plot.runs = plot.inside(sides);
        Ok(Some(plot))
    }

    /// Where a point of the grid lies.
    pub(crate) fn at(&self, column: usize, row: usize) -> DVec2 {
        self.low + self.step * DVec2::new(column as f64, row as f64)
    }

    /// The columns or rows that lie from `from` to `to`, counted from the low corner in mm, without the last.
    pub(crate) fn between(&self, from: f64, to: f64, count: usize) -> std::ops::Range<usize> {
        // Float to integer casts saturate.
        let first = |value: f64| ((value / self.step).ceil() as usize).min(count);
        first(from)..first(to)
    }

    fn inside(&self, sides: &[Segment]) -> Vec<(usize, usize, usize)> {
        let mut crossings: Vec<(usize, f64)> = Vec::new();
        for side in sides {
            let (from, to) = (side.start - self.low, side.end - self.low);
            let (below, above) = if from.y < to.y { (from, to) } else { (to, from) };
            let slope = (above.x - below.x) / (above.y - below.y);
            for row in self.between(below.y, above.y, self.rows) {
                crossings.push((row, below.x + (row as f64 * self.step - below.y) * slope));
            }
        }
        crossings.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let pairs = crossings.chunks_exact(2).filter(|pair| pair[0].0 == pair[1].0);
        pairs
            .map(|pair| (pair[0].0, self.between(pair[0].1, pair[1].1, self.columns - 1)))
            .filter(|(_, columns)| !columns.is_empty())
            .map(|(row, columns)| (row, columns.start.max(1), columns.end - 1))
            .collect()
    }
}
