//! Distances from the strand at the points of a grid, inside of a region.

use argil_curve::{DVec2, Segment};

/// So many points are held at a time: rows are taken band by band.
const BAND: usize = 1 << 20;

/// A point of the grid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample {
    pub(crate) row: i64,
    pub(crate) column: i64,
    pub(crate) at: DVec2,
    /// Distance from the strand, mm; infinite beyond the reach that was asked for.
    pub(crate) distance: f64,
}

/// The points of one row that lie next to each other inside of the region.
#[derive(Clone, Copy, Debug)]
struct Run {
    row: i64,
    first: i64,
    last: i64,
    /// Where its points begin in the band.
    offset: usize,
}

/// Visits the points of a square grid that lie inside of `sides` by the even-odd rule, row by row, with their distance from the
/// `strand` up to `reach`.
///
/// Each segment of the strand writes its distance to the points near it, so that no point has to look for its segment.
///
/// # Complexity
/// O(points inside + points within reach of the strand); a band of rows is held at a time.
pub(crate) fn survey(
    sides: &[Segment],
    strand: &[Segment],
    step: f64,
    reach: f64,
    mut visit: impl FnMut(Sample),
) {
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for side in sides {
        (low, high) = (low.min(side.start), high.max(side.start));
    }
    if !(step > 0.0 && (high - low).is_finite() && (high - low).min_element() > 0.0) {
        return;
    }
    let grid = Lattice { low, step };
    let runs = grid.runs(sides);
    let mut begin = 0;
    while begin < runs.len() {
        let mut points = 0;
        let mut end = begin;
        // Whole rows, and at least one.
        while end < runs.len() && (points < BAND || runs[end].row == runs[end - 1].row) {
            points += (runs[end].last - runs[end].first + 1) as usize;
            end += 1;
        }
        grid.fill_band(&runs[begin..end], strand, reach, &mut visit);
        begin = end;
    }
}

/// Where the points are.
#[derive(Clone, Copy, Debug)]
struct Lattice {
    low: DVec2,
    step: f64,
}

impl Lattice {
    fn x(&self, column: i64) -> f64 {
        self.low.x + (column as f64 + 0.5) * self.step
    }

    fn y(&self, row: i64) -> f64 {
        self.low.y + (row as f64 + 0.5) * self.step
    }

    /// The first row or column at or beyond a coordinate, which is counted from the low corner.
    fn first(&self, coordinate: f64) -> i64 {
        (coordinate / self.step - 0.5).ceil() as i64
    }

    /// The points inside, by rows and in each row from low to high.
    fn runs(&self, sides: &[Segment]) -> Vec<Run> {
        let mut crossings: Vec<(i64, f64)> = Vec::new();
        for side in sides {
            let (from, to) = (side.start - self.low, side.end - self.low);
            let (below, above) = if from.y < to.y { (from, to) } else { (to, from) };
            let slope = (above.x - below.x) / (above.y - below.y);
            for row in self.first(below.y)..self.first(above.y) {
                let y = (row as f64 + 0.5) * self.step;
                crossings.push((row, below.x + (y - below.y) * slope));
            }
        }
        crossings.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let mut runs = Vec::with_capacity(crossings.len() / 2);
        for pair in crossings.chunks_exact(2) {
            let (row, first, last) = (pair[0].0, self.first(pair[0].1), self.first(pair[1].1) - 1);
            if first <= last {
                runs.push(Run { row, first, last, offset: 0 });
            }
        }
        runs
    }

    fn fill_band(&self, runs: &[Run], strand: &[Segment], reach: f64, visit: &mut impl FnMut(Sample)) {
        let (Some(south), Some(north)) = (runs.first().map(|r| r.row), runs.last().map(|r| r.row)) else {
            return;
        };
        let mut runs = runs.to_vec();
        let mut points = 0;
        for run in &mut runs {
            run.offset = points;
            points += (run.last - run.first + 1) as usize;
        }
        // Runs of row r are runs[starts[r - south]..starts[r - south + 1]].
        let mut starts = vec![0; (north - south + 2) as usize];
        for run in &runs {
            starts[(run.row - south + 1) as usize] += 1;
        }
        for row in 1..starts.len() {
            starts[row] += starts[row - 1];
        }
        let mut squared = vec![f64::INFINITY; points];
        for segment in strand {
            let (from, to) = (segment.start - self.low, segment.end - self.low);
            let along = to - from;
            let scale = along.length_squared();
            let scale = if scale > 0.0 { 1.0 / scale } else { 0.0 };
            let (below, above) = (from.y.min(to.y), from.y.max(to.y));
            for row in self.first(below - reach).max(south)..self.first(above + reach).min(north + 1) {
                let own = starts[(row - south) as usize]..starts[(row - south + 1) as usize];
                let y = (row as f64 + 0.5) * self.step;
                let (west, east) = extent(from, to, y, reach);
                let (west, east) = (self.first(west), self.first(east) - 1);
                let rise = (y - from.y) * along.y;
                for run in &runs[own] {
                    for column in run.first.max(west)..=run.last.min(east) {
                        let x = (column as f64 + 0.5) * self.step - from.x;
                        let t = ((x * along.x + rise) * scale).clamp(0.0, 1.0);
                        let away = DVec2::new(x - t * along.x, y - from.y - t * along.y);
                        let least = &mut squared[run.offset + (column - run.first) as usize];
                        *least = least.min(away.length_squared());
                    }
                }
            }
        }
        for run in &runs {
            for column in run.first..=run.last {
                let square = squared[run.offset + (column - run.first) as usize];
                let distance = if square <= reach * reach { square.sqrt() } else { f64::INFINITY };
                let at = DVec2::new(self.x(column), self.y(run.row));
                visit(Sample { row: run.row, column, at, distance });
            }
        }
    }
}

/// From where to where a segment has points of height `y` within reach.
fn extent(from: DVec2, to: DVec2, y: f64, reach: f64) -> (f64, f64) {
    let rise = to.y - from.y;
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    if rise.abs() > reach {
        let (a, b) = ((y - reach - from.y) / rise, (y + reach - from.y) / rise);
        (first, last) = (a.min(b).clamp(0.0, 1.0), a.max(b).clamp(0.0, 1.0));
    }
    let (a, b) = (from.x + first * (to.x - from.x), from.x + last * (to.x - from.x));
    (a.min(b) - reach, a.max(b) + reach)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(corners: &[(f64, f64)]) -> Vec<Segment> {
        let at = |k: usize| DVec2::from(corners[k % corners.len()]);
        (0..corners.len()).map(|k| Segment::new(at(k), at(k + 1))).collect()
    }

    #[test]
    fn every_point_has_its_distance() {
        // A frame, so that rows have one run or two.
        let mut sides = ring(&[(0.0, 0.0), (9.0, 1.0), (10.0, 8.0), (-1.0, 7.0)]);
        sides.extend(ring(&[(3.0, 3.0), (3.0, 5.0), (6.0, 5.0), (6.0, 3.0)]));
        let strand = [
            Segment::new(DVec2::new(0.0, 1.0), DVec2::new(8.0, 7.0)),
            Segment::new(DVec2::new(2.0, 2.0), DVec2::new(2.0, 2.0)),
        ];
        let (mut area, mut beyond) = (0.0_f64, 0);
        survey(&sides, &strand, 0.05, 2.0, |sample| {
            let truth = strand.iter().map(|s| s.distance(sample.at)).fold(f64::INFINITY, f64::min);
            if sample.distance.is_finite() {
                assert!((sample.distance - truth).abs() < 1e-9, "{sample:?} {truth}");
            } else {
                assert!(truth > 2.0, "{sample:?} {truth}");
                beyond += 1;
            }
            area += 0.05 * 0.05;
        });
        assert!((area - (70.0 - 6.0)).abs() < 0.2, "{area}");
        assert!(beyond > 0);
    }

    #[test]
    fn of_nothing() {
        let flat = ring(&[(0.0, 0.0), (1.0, 0.0)]);
        survey(&flat, &flat, 0.1, 1.0, |sample| panic!("{sample:?}"));
        survey(&[], &[], 0.1, 1.0, |sample| panic!("{sample:?}"));
    }
}
