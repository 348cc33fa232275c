//! A uniform grid over a set of segments, for distance and neighbourhood queries.

use crate::{ClosedCurve, Segment};
use glam::DVec2;

/// Coordinates beyond this are left out of the grid: their squares overflow, so distances to them mean
/// nothing.
const LARGEST: f64 = 1e150;

/// Cells allowed for each segment. A finer grid would spend its time on empty cells and, for segments that
/// lie far apart, its memory too.
const CELLS_PER_SEGMENT: usize = 4;

/// Within a radius of up to this many cells a search looks at all of them, row by row; beyond it goes from the
/// middle outwards, to end early.
const FEW_CELLS: f64 = 2.0;

/// A set of segments in a uniform grid: built once, then asked often.
///
/// Queries allocate nothing. Segments with a coordinate that is not finite (or beyond 1e150) stay in
/// [`segments`](Self::segments), so that indices mean what the caller thinks, but are never found.
///
/// # Example
/// ```
/// use argil_curve::{DVec2, NearestSegment, Segment, SegmentIndex};
/// let rail = |y: f64| Segment::new(DVec2::new(0.0, y), DVec2::new(10.0, y));
/// let index = SegmentIndex::new(vec![rail(0.0), rail(3.0)], 1.0);
/// let nearest: NearestSegment = index.nearest(DVec2::new(5.0, 2.0)).unwrap();
/// assert_eq!((nearest.index, nearest.distance), (1, 1.0));
/// let mut near = Vec::new();
/// index.for_each_near(rail(-0.5), 0.6, |k, _| near.push(k));
/// assert_eq!(near, [0]);
/// assert!(index.nearest_within(DVec2::new(5.0, 1.5), 1.0).is_none());
/// ```
#[derive(Clone, Debug)]
pub struct SegmentIndex {
    segments: Vec<Segment>,
    /// The cells of each segment; `None` for those that are left out.
    footprints: Vec<Option<Footprint>>,
    grid: Grid,
    /// Items of cell c are `items[offsets[c]..offsets[c + 1]]`, in ascending order of their indices.
    offsets: Vec<u32>,
    items: Vec<Item>,
}

/// A segment in a cell. It is kept by value: a query then reads a cell's segments from one place in memory.
#[derive(Clone, Copy, Debug)]
struct Item {
    segment: Segment,
    index: u32,
}

/// The segment of an index that is nearest to some point.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NearestSegment {
    /// Index of the segment in [`SegmentIndex::segments`].
    pub index: usize,
    /// The point of the segment that is nearest, mm.
    pub point: DVec2,
    /// Its distance from the point that was asked about, mm.
    pub distance: f64,
}

impl SegmentIndex {
    /// An index over `segments` with square cells of side `cell` mm; about the length of a segment or the
    /// usual query radius, whichever is larger, serves best. The side grows where the grid would have more
    /// than four cells a segment; one that is not positive is chosen from the extent of the set.
    ///
    /// # Complexity
    /// O(n + cells covered by the segments).
    #[must_use]
    pub fn new(segments: Vec<Segment>, cell: f64) -> Self {
        let grid = Grid::over(&segments, cell);
        let footprints: Vec<Option<Footprint>> =
            segments.iter().map(|s| if is_indexable(s) { grid.footprint(s, 0.0) } else { None }).collect();
        let mut offsets = vec![0_u32; grid.columns as usize * grid.rows as usize + 1];
        for (segment, footprint) in segments.iter().zip(&footprints) {
            grid.for_each_cell(segment, footprint, |cell| offsets[cell + 1] += 1);
        }
        for cell in 1..offsets.len() {
            offsets[cell] += offsets[cell - 1];
        }
        let nothing = Item { segment: Segment::new(DVec2::ZERO, DVec2::ZERO), index: 0 };
        let mut items = vec![nothing; offsets[offsets.len() - 1] as usize];
        let mut next = offsets.clone();
        for (k, (segment, footprint)) in segments.iter().zip(&footprints).enumerate() {
            grid.for_each_cell(segment, footprint, |cell| {
                items[next[cell] as usize] = Item { segment: *segment, index: k as u32 };
                next[cell] += 1;
            });
        }
        Self { segments, footprints, grid, offsets, items }
    }

    /// An index over all segments of `curves`, in order.
    #[must_use]
    pub fn of_curves<'a>(curves: impl IntoIterator<Item = &'a ClosedCurve>, cell: f64) -> Self {
        Self::new(curves.into_iter().flat_map(ClosedCurve::segments).collect(), cell)
    }

    /// The segments, in the order in which they were given.
    #[must_use]
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// Whether there is no segment that a query could find.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.items.is_empty()
    }

    /// The segment nearest to `p`, the one of the lowest index among equals; `None` when the index is empty
    /// or `p` is not finite.
    ///
    /// # Complexity
    /// O(1) near evenly spread segments; never more than the number of cells and items.
    #[must_use]
    pub fn nearest(&self, p: DVec2) -> Option<NearestSegment> {
        self.search(p, f64::INFINITY)
    }

    /// Distance from `p` to the nearest segment, mm; infinity when there is none.
    #[must_use]
    pub fn distance(&self, p: DVec2) -> f64 {
        self.nearest(p).map_or(f64::INFINITY, |nearest| nearest.distance)
    }

    /// The nearest segment, if it lies no further than `radius` mm from `p`.
    #[must_use]
    pub fn nearest_within(&self, p: DVec2, radius: f64) -> Option<NearestSegment> {
        if radius <= FEW_CELLS * self.grid.cell {
            self.search_block(p, radius)
        } else {
            self.search(p, radius)
        }
    }

    /// Whether any segment lies no further than `radius` mm from `p`.
    ///
    /// # Complexity
    /// As for [`nearest_within`](Self::nearest_within), but it ends at the first segment found.
    #[must_use]
    pub fn is_within(&self, p: DVec2, radius: f64) -> bool {
        if self.is_empty() || !p.is_finite() || radius < 0.0 {
            return false;
        }
        if radius.is_nan() || radius > FEW_CELLS * self.grid.cell {
            return self.search(p, radius).is_some();
        }
        let Some(block) = self.grid.footprint(&Segment::new(p, p), radius) else { return false };
        (block.south..=block.north).any(|row| {
            self.items_of_run(block.west, block.east, row)
                .iter()
                .any(|item| item.segment.is_within(p, radius))
        })
    }

    /// Visits every segment that may lie within `radius` mm of `segment`, each once, in an order that depends
    /// on nothing but the index and the query. Some that lie a cell further are visited too: the caller
    /// measures.
    ///
    /// # Complexity
    /// O(cells within the radius + segments in them), without allocation.
    pub fn for_each_near(&self, segment: Segment, radius: f64, mut visit: impl FnMut(usize, Segment)) {
        if self.is_empty() || !is_indexable(&segment) || radius.is_nan() || radius < 0.0 {
            return;
        }
        let radius = radius.min(LARGEST);
        let Some(asked) = self.grid.footprint(&segment, radius) else { return };
        for row in asked.south..=asked.north {
            let Some((first, last)) = self.grid.columns_of(&segment, &asked, row, radius) else { continue };
            for column in first..=last {
                for item in self.items_of(column as usize, row as usize) {
                    let index = item.index as usize;
                    let Some(stored) = &self.footprints[index] else { continue };
                    // A segment is reported from the first cell, row by row, that it shares with the query.
                    let first_shared = if stored.whole && asked.whole {
                        column == stored.west.max(asked.west) && row == stored.south.max(asked.south)
                    } else {
                        let first = self.first_shared(index, stored, &segment, &asked, radius, row);
                        first == Some((column, row))
                    };
                    if first_shared {
                        visit(index, item.segment);
                    }
                }
            }
        }
    }

    /// The first cell that a stored segment shares with a query, looked for in the rows up to `last_row`.
    fn first_shared(
        &self,
        index: usize,
        stored: &Footprint,
        query: &Segment,
        asked: &Footprint,
        radius: f64,
        last_row: u32,
    ) -> Option<(u32, u32)> {
        (stored.south.max(asked.south)..=last_row).find_map(|row| {
            let (west, east) = self.grid.columns_of(&self.segments[index], stored, row, 0.0)?;
            let (first, last) = self.grid.columns_of(query, asked, row, radius)?;
            (west.max(first) <= east.min(last)).then_some((west.max(first), row))
        })
    }

    fn items_of(&self, column: usize, row: usize) -> &[Item] {
        let cell = row * self.grid.columns as usize + column;
        &self.items[self.offsets[cell] as usize..self.offsets[cell + 1] as usize]
    }

    /// The items of the cells from column `west` to `east` of a row, which lie side by side.
    fn items_of_run(&self, west: u32, east: u32, row: u32) -> &[Item] {
        let cell = row as usize * self.grid.columns as usize;
        let (from, to) = (self.offsets[cell + west as usize], self.offsets[cell + east as usize + 1]);
        &self.items[from as usize..to as usize]
    }

    /// The nearest segment within a radius of few cells: the cell of `p` first, then row by row what is left of
    /// the block of cells within the distance found there.
    fn search_block(&self, p: DVec2, radius: f64) -> Option<NearestSegment> {
        if self.is_empty() || !p.is_finite() || radius < 0.0 {
            return None;
        }
        let point = Segment::new(p, p);
        let mut best = None;
        let (column, row) = self.grid.cell_at(p);
        self.improve(p, radius, self.items_of(column, row), &mut best);
        let reached = best.map_or(radius, |b| b.distance);
        let block = self.grid.footprint(&point, reached)?;
        for row in block.south..=block.north {
            self.improve(p, radius, self.items_of_run(block.west, block.east, row), &mut best);
        }
        best
    }

    /// Rings of cells about the cell nearest to `p`, until what is left of the grid lies further away than
    /// the best segment so far.
    fn search(&self, p: DVec2, limit: f64) -> Option<NearestSegment> {
        if self.is_empty() || !p.is_finite() {
            return None;
        }
        let (column, row) = self.grid.cell_at(p);
        let mut best: Option<NearestSegment> = None;
        let (column_count, row_count) = (self.grid.columns as usize, self.grid.rows as usize);
        let mut ring = 0;
        loop {
            let (west, east) = (column.checked_sub(ring), Some(column + ring).filter(|&c| c < column_count));
            let (south, north) = (row.checked_sub(ring), Some(row + ring).filter(|&r| r < row_count));
            let columns = west.unwrap_or(0)..=east.unwrap_or(column_count - 1);
            for row in south.into_iter().chain(north.filter(|_| ring > 0)) {
                for column in columns.clone() {
                    self.improve(p, limit, self.items_of(column, row), &mut best);
                }
            }
            if ring > 0 {
                let above = south.map_or(0, |s| s + 1);
                let below = north.unwrap_or(row_count);
                for column in west.into_iter().chain(east) {
                    for row in above..below {
                        self.improve(p, limit, self.items_of(column, row), &mut best);
                    }
                }
            }
            let reached = best.map_or(limit, |b| b.distance);
            match self.grid.distance_beyond(p, column, row, ring) {
                Some(beyond) if beyond <= reached => ring += 1,
                _ => return best,
            }
        }
    }

    fn improve(&self, p: DVec2, limit: f64, items: &[Item], best: &mut Option<NearestSegment>) {
        let mut reached = best.map_or(limit, |b| b.distance);
        for item in items {
            if item.segment.is_beyond(p, reached) {
                continue;
            }
            let index = item.index as usize;
            let nearest = item.segment.nearest(p);
            let better = match best {
                Some(b) => {
                    nearest.distance < b.distance || (nearest.distance == b.distance && index < b.index)
                }
                None => nearest.distance <= limit,
            };
            if better {
                reached = nearest.distance;
                *best = Some(NearestSegment { index, point: nearest.point, distance: nearest.distance });
            }
        }
    }
}

fn is_indexable(segment: &Segment) -> bool {
    let within = |p: DVec2| p.x.abs() <= LARGEST && p.y.abs() <= LARGEST;
    within(segment.start) && within(segment.end)
}

/// The cells: where they lie and which of them a segment, or all within a radius of it, touches.
///
/// Both the filling and the asking use the same footprints, so a segment that lies within the radius always
/// shares a cell with the query.
#[derive(Clone, Debug)]
struct Grid {
    origin: DVec2,
    cell: f64,
    columns: u32,
    rows: u32,
    /// Added on every side of a footprint so that rounding loses no cell, mm.
    slack: f64,
}

/// Footprints of up to this many cells take their whole rectangle; larger ones only a run of columns in each
/// row, lest a long diagonal fill a square.
const SMALL: u32 = 16;

/// The cells that a segment touches: within a rectangle, all of it or one run of columns a row.
#[derive(Clone, Copy, Debug)]
struct Footprint {
    west: u32,
    east: u32,
    south: u32,
    north: u32,
    whole: bool,
}

impl Grid {
    fn over(segments: &[Segment], cell: f64) -> Self {
        let mut low = DVec2::INFINITY;
        let mut high = DVec2::NEG_INFINITY;
        let mut count = 0;
        for s in segments.iter().filter(|s| is_indexable(s)) {
            low = low.min(s.start).min(s.end);
            high = high.max(s.start).max(s.end);
            count += 1;
        }
        if count == 0 {
            return Self { origin: DVec2::ZERO, cell: 1.0, columns: 1, rows: 1, slack: 0.0 };
        }
        let extent = high - low;
        let most = (CELLS_PER_SEGMENT * count + 4) as f64;
        let wanted =
            if cell > 0.0 && cell.is_finite() { cell } else { extent.max_element() / (count as f64).sqrt() };
        let mut cell = wanted.max(extent.max_element() / most).max(f64::MIN_POSITIVE);
        let cells = |cell: f64| (extent / cell).floor() + DVec2::ONE;
        while cells(cell).element_product() > most {
            cell *= 1.25;
        }
        let count = cells(cell);
        let slack = 1e-9 * cell + 8.0 * f64::EPSILON * low.abs().max(high.abs()).max_element();
        Self { origin: low, cell, columns: count.x as u32, rows: count.y as u32, slack }
    }

    fn cell_at(&self, p: DVec2) -> (usize, usize) {
        // Float to integer casts saturate, so points far outside land in the border cells.
        let at = (p - self.origin) / self.cell;
        ((at.x as u32).min(self.columns - 1) as usize, (at.y as u32).min(self.rows - 1) as usize)
    }

    /// The run of cells along one axis that meets the interval from `low` to `high`, measured from the
    /// origin.
    fn run(&self, low: f64, high: f64, count: u32) -> Option<(u32, u32)> {
        let (first, last) = (low / self.cell, high / self.cell);
        if last < 0.0 || first >= f64::from(count) || first.is_nan() || last.is_nan() {
            return None;
        }
        Some((first as u32, (last as u32).min(count - 1)))
    }

    /// The cells that hold points within `radius` of the segment; `None` when all lie outside the grid.
    fn footprint(&self, s: &Segment, radius: f64) -> Option<Footprint> {
        let reach = radius + self.slack;
        let low = s.start.min(s.end) - self.origin - reach;
        let high = s.start.max(s.end) - self.origin + reach;
        let (west, east) = self.run(low.x, high.x, self.columns)?;
        let (south, north) = self.run(low.y, high.y, self.rows)?;
        let whole = (u64::from(east - west) + 1) * (u64::from(north - south) + 1) <= u64::from(SMALL);
        Some(Footprint { west, east, south, north, whole })
    }

    /// The columns of a footprint in one of its rows.
    fn columns_of(&self, s: &Segment, footprint: &Footprint, row: u32, radius: f64) -> Option<(u32, u32)> {
        if footprint.whole {
            return Some((footprint.west, footprint.east));
        }
        let reach = radius + self.slack;
        let (a, b) = (s.start - self.origin, s.end - self.origin);
        let low = f64::from(row) * self.cell - reach;
        let high = (f64::from(row) + 1.0) * self.cell + reach;
        let rise = b.y - a.y;
        let (mut from, mut to) = (0.0, 1.0);
        if rise != 0.0 {
            let (t, u) = ((low - a.y) / rise, (high - a.y) / rise);
            (from, to) = (t.min(u).clamp(0.0, 1.0), t.max(u).clamp(0.0, 1.0));
        }
        let (x, y) = (a.x + from * (b.x - a.x), a.x + to * (b.x - a.x));
        self.run(x.min(y) - reach, x.max(y) + reach, self.columns)
    }

    fn for_each_cell(&self, s: &Segment, footprint: &Option<Footprint>, mut visit: impl FnMut(usize)) {
        let Some(footprint) = footprint else { return };
        for row in footprint.south..=footprint.north {
            if let Some((west, east)) = self.columns_of(s, footprint, row, 0.0) {
                (west..=east)
                    .for_each(|column| visit(row as usize * self.columns as usize + column as usize));
            }
        }
    }

    /// Least distance from `p` to the part of the grid outside the block of cells within `ring` of a cell,
    /// less the rounding; `None` when the block covers the grid.
    fn distance_beyond(&self, p: DVec2, column: usize, row: usize, ring: usize) -> Option<f64> {
        let p = p - self.origin;
        let (columns, rows) = (self.columns as usize, self.rows as usize);
        let size = DVec2::new(columns as f64, rows as f64) * self.cell;
        let to_box = |low: DVec2, high: DVec2| (p - p.clamp(low, high)).length();
        let edge = |cells: usize| cells as f64 * self.cell;
        let mut least: Option<f64> = None;
        let mut consider = |low: DVec2, high: DVec2| {
            let distance = (to_box(low, high) - 2.0 * self.slack).max(0.0);
            least = Some(least.map_or(distance, |l: f64| l.min(distance)));
        };
        if column > ring {
            consider(DVec2::ZERO, DVec2::new(edge(column - ring), size.y));
        }
        if column + ring + 1 < columns {
            consider(DVec2::new(edge(column + ring + 1), 0.0), size);
        }
        if row > ring {
            consider(DVec2::ZERO, DVec2::new(size.x, edge(row - ring)));
        }
        if row + ring + 1 < rows {
            consider(DVec2::new(0.0, edge(row + ring + 1)), size);
        }
        least
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(x: f64, y: f64) -> Segment {
        Segment::new(DVec2::new(x, y), DVec2::new(x, y))
    }

    #[test]
    fn empty_and_odd_sets_answer_nothing() {
        let empty = SegmentIndex::new(Vec::new(), 1.0);
        assert!(empty.is_empty() && empty.nearest(DVec2::ZERO).is_none());
        assert_eq!(empty.distance(DVec2::ZERO), f64::INFINITY);
        let odd = SegmentIndex::new(vec![point(f64::NAN, 0.0), point(1e200, 0.0), point(2.0, 0.0)], f64::NAN);
        assert_eq!(odd.nearest(DVec2::ZERO).map(|n| n.index), Some(2));
        assert_eq!(odd.nearest(DVec2::NAN), None);
    }

    #[test]
    fn far_apart_segments_keep_the_grid_small() {
        let index = SegmentIndex::new(vec![point(0.0, 0.0), point(1e9, 1e9), point(-1e9, 3.0)], 1e-6);
        assert!(index.offsets.len() <= 4 * 3 + 5);
        assert_eq!(index.nearest(DVec2::new(4e8, 4e8)).map(|n| n.index), Some(0));
        assert_eq!(index.nearest(DVec2::new(1e12, 1e12)).map(|n| n.index), Some(1));
    }

    #[test]
    fn equal_points_share_one_cell() {
        let index = SegmentIndex::new(vec![point(5.0, 5.0); 3], 1.0);
        assert_eq!(index.nearest(DVec2::new(5.0, 6.0)).map(|n| n.index), Some(0));
        let mut seen = Vec::new();
        index.for_each_near(point(5.0, 5.0), 0.0, |k, _| seen.push(k));
        assert_eq!(seen, [0, 1, 2]);
    }

    #[test]
    fn a_long_diagonal_fills_no_square() {
        let mut segments: Vec<Segment> = (0..1000).map(|k| point(f64::from(k), 0.0)).collect();
        segments.push(Segment::new(DVec2::ZERO, DVec2::new(1000.0, 1000.0)));
        let index = SegmentIndex::new(segments, 1.0);
        assert!(index.items.len() < 2_000);
    }
}
