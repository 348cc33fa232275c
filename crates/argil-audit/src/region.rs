//! Which points lie inside a set of rings, asked a hundred thousand times a layer.

use argil_curve::DVec2;

/// Rows beyond this cost more memory than they save tests.
const MOST_ROWS: usize = 512;

/// The edges of closed rings, sorted into rows by y, so that a point is tested against the edges of its row
/// alone.
#[derive(Clone, Debug)]
pub(crate) struct Region {
    low: f64,
    height: f64,
    rows: Vec<Vec<(DVec2, DVec2)>>,
}

impl Region {
    /// The region inside `rings` by the even-odd rule; each ring repeats its first point at the end.
    ///
    /// # Complexity
    /// O(edges times rows that each spans), at most 512 rows.
    pub(crate) fn new(rings: &[Vec<DVec2>]) -> Self {
        let edges = || rings.iter().flat_map(|ring| ring.windows(2)).filter(|e| e[0].y != e[1].y);
        let (mut low, mut high, mut count) = (f64::INFINITY, f64::NEG_INFINITY, 0);
        for e in edges() {
            low = low.min(e[0].y.min(e[1].y));
            high = high.max(e[0].y.max(e[1].y));
            count += 1;
        }
        if count == 0 {
            return Self { low: 0.0, height: 1.0, rows: Vec::new() };
        }
        let row_count = count.clamp(1, MOST_ROWS);
        let height = ((high - low) / row_count as f64).max(f64::MIN_POSITIVE);
        let mut region = Self { low, height, rows: vec![Vec::new(); row_count] };
        for e in edges() {
            let first = region.row(e[0].y.min(e[1].y));
            let last = region.row(e[0].y.max(e[1].y));
            region.rows[first..=last].iter_mut().for_each(|row| row.push((e[0], e[1])));
        }
        region
    }

    /// Whether `p` lies inside.
    pub(crate) fn contains(&self, p: DVec2) -> bool {
        if self.rows.is_empty() || p.y < self.low {
            return false;
        }
        let mut inside = false;
        for &(a, b) in &self.rows[self.row(p.y)] {
            if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) {
                inside = !inside;
            }
        }
        inside
    }

    fn row(&self, y: f64) -> usize {
        // The cast saturates, so a point far above lands in the top row, whose edges it does not meet.
        (((y - self.low) / self.height) as usize).min(self.rows.len().saturating_sub(1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(points: &[(f64, f64)]) -> Vec<DVec2> {
        points.iter().chain(points.first()).map(|&p| p.into()).collect()
    }

    #[test]
    fn holes_are_outside() {
        let outer = ring(&[(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)]);
        let hole = ring(&[(3.0, 3.0), (3.0, 6.0), (6.0, 6.0), (6.0, 3.0)]);
        let region = Region::new(&[outer, hole]);
        let inside = |x: f64, y: f64| region.contains(DVec2::new(x, y));
        assert!(inside(1.0, 1.0) && inside(1.0, 4.5) && inside(8.0, 8.9));
        assert!(!inside(4.5, 4.5) && !inside(-1.0, 4.5) && !inside(4.0, -1.0) && !inside(4.0, 1e300));
        assert!(!Region::new(&[]).contains(DVec2::ZERO));
    }
}
