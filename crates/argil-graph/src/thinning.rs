//! Which Steiner points are kept: those with room round them.

use glam::DVec2;

/// Below this distance in mm two points count as one however small a spacing is asked for: a hundredth of the
/// grid that walls lie on, so that no Steiner point can sit on a wall.
const LEAST_SPACING: f64 = 1e-6;

/// Cells along the longer side of the points' box at most; it bounds the work for a spacing that is tiny
/// against the extent.
const MOST_CELLS: f64 = 4096.0;

/// Thins `steiner` and returns the kept points in their order.
///
/// A point is dropped when it lies outside the box `within`, closer than `spacing` to a point of `vertices`
/// or to a kept Steiner point, or closer than half of `spacing` to a wall segment. The points are taken in
/// order, so the result does not depend on anything but the input.
///
/// # Complexity
/// O((n + m) log n) for evenly spread points, with m the number of grid columns that the walls pass.
pub(crate) fn thin(
    steiner: &[DVec2],
    vertices: impl Iterator<Item = DVec2>,
    walls: impl Iterator<Item = (DVec2, DVec2)>,
    within: Option<(DVec2, DVec2)>,
    spacing: f64,
) -> Vec<DVec2> {
    let spacing = spacing.max(LEAST_SPACING);
    let clearance = 0.5 * spacing;
    let inside = |p: DVec2| within.is_none_or(|(low, high)| p.cmpge(low).all() && p.cmple(high).all());
    let candidates: Vec<DVec2> = steiner.iter().copied().filter(|&p| inside(p)).collect();
    let Some(cells) = Cells::new(&candidates, spacing) else {
        return Vec::new();
    };
    let mut alive = vec![true; candidates.len()];
    for p in vertices {
        cells.visit_square(p, spacing, |k| alive[k] &= candidates[k].distance(p) >= spacing);
    }
    for (start, end) in walls {
        cells.visit_along(start, end, clearance, |k| {
            alive[k] &= distance_to_segment(candidates[k], start, end) >= clearance;
        });
    }
    for k in 0..candidates.len() {
        if alive[k] {
            let p = candidates[k];
            cells.visit_square(p, spacing, |j| {
                alive[j] &= j <= k || candidates[j].distance(p) >= spacing;
            });
        }
    }
    candidates.into_iter().zip(alive).filter_map(|(p, alive)| alive.then_some(p)).collect()
}

/// The points sorted by the column and row of their cell: a column's rows are one contiguous run.
struct Cells {
    origin: DVec2,
    cell: f64,
    last_column: i32,
    sorted: Vec<(i32, i32, u32)>,
    /// Where the points of each column begin.
    columns: Vec<u32>,
}

impl Cells {
    fn new(points: &[DVec2], spacing: f64) -> Option<Cells> {
        let low = points.iter().copied().reduce(DVec2::min)?;
        let high = points.iter().copied().reduce(DVec2::max)?;
        let cell = spacing.max((high - low).max_element() / MOST_CELLS);
        let mut cells = Cells { origin: low, cell, last_column: 0, sorted: Vec::new(), columns: Vec::new() };
        cells.last_column = cells.column(high.x);
        cells.sorted = points.iter().zip(0..).map(|(p, k)| (cells.column(p.x), cells.row(p.y), k)).collect();
        cells.sorted.sort_unstable();
        cells.columns.resize(cells.last_column.max(0) as usize + 2, 0);
        for &(column, _, _) in &cells.sorted {
            cells.columns[column as usize + 1] += 1;
        }
        for column in 1..cells.columns.len() {
            cells.columns[column] += cells.columns[column - 1];
        }
        Some(cells)
    }

    fn column(&self, x: f64) -> i32 {
        ((x - self.origin.x) / self.cell).floor() as i32
    }

    fn row(&self, y: f64) -> i32 {
        ((y - self.origin.y) / self.cell).floor() as i32
    }

    fn visit_rows(&self, column: i32, low: f64, high: f64, visit: &mut impl FnMut(usize)) {
        let (first, last) = (self.row(low), self.row(high));
        let (from, to) = (self.columns[column as usize], self.columns[column as usize + 1]);
        let own = &self.sorted[from as usize..to as usize];
        let begin = own.partition_point(|&(_, row, _)| row < first);
        for &(_, _, k) in own[begin..].iter().take_while(|&&(_, row, _)| row <= last) {
            visit(k as usize);
        }
    }

    /// Visits every point in the square of half side `radius` round `p`, and some more.
    fn visit_square(&self, p: DVec2, radius: f64, mut visit: impl FnMut(usize)) {
        let (first, last) =
            (self.column(p.x - radius).max(0), self.column(p.x + radius).min(self.last_column));
        for column in first..=last {
            self.visit_rows(column, p.y - radius, p.y + radius, &mut visit);
        }
    }

    /// Visits every point that can be within `radius` of the segment, and some more.
    fn visit_along(&self, start: DVec2, end: DVec2, radius: f64, mut visit: impl FnMut(usize)) {
        let (left, right) = if start.x <= end.x { (start, end) } else { (end, start) };
        let (first, last) =
            (self.column(left.x - radius).max(0), self.column(right.x + radius).min(self.last_column));
        let width = right.x - left.x;
        for column in first..=last {
            // The stretch of the segment within `radius` of the column's slab; one cell of slack on both
            // sides covers the rounding of the division.
            let slab = self.origin.x + f64::from(column) * self.cell;
            let height_at = |x: f64| {
                let t = if width > 0.0 { ((x - left.x) / width).clamp(0.0, 1.0) } else { 0.0 };
                left.y + t * (right.y - left.y)
            };
            let (mut a, mut b) = (height_at(slab - radius), height_at(slab + self.cell + radius));
            if width <= radius {
                (a, b) = (left.y, right.y);
            }
            let reach = radius + self.cell;
            self.visit_rows(column, a.min(b) - reach, a.max(b) + reach, &mut visit);
        }
    }
}

fn distance_to_segment(p: DVec2, start: DVec2, end: DVec2) -> f64 {
    let along = end - start;
    let length_squared = along.length_squared();
    let t =
        if length_squared > 0.0 { ((p - start).dot(along) / length_squared).clamp(0.0, 1.0) } else { 0.0 };
    p.distance(start + t * along)
}
