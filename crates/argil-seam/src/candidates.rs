//! The places where a layer may start.

use argil_curve::{ClosedCurve, DVec2, OnCurve, Segment};

/// Candidates of one layer are never more than this, whatever the spacing; the answer would be no better.
const MOST_CANDIDATES: f64 = 1e6;

/// A place this near to a vertex is at the vertex, mm: where the strand would be cut it is no farther from it on the output
/// grid.
const ON_VERTEX: f64 = 1e-3;

/// Cells of the grid for each candidate. A candidate's strand fills few cells, so most are empty; their
/// number bounds the time to clear them.
const CELLS_PER_CANDIDATE: usize = 8;

/// The walk along a cycle at one of its places.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Headings {
    /// Direction in which it comes, where the layer ends.
    pub(crate) arriving: DVec2,
    /// Direction in which it goes on, where the layer begins.
    pub(crate) leaving: DVec2,
}

/// Places along a cycle.
pub(crate) struct Candidates {
    pub(crate) points: Vec<DVec2>,
    /// Direction in which the walk along the cycle comes to each, and in which it goes on; of length 1.
    pub(crate) headings: Vec<Headings>,
    /// Arc length of each, mm.
    pub(crate) arcs: Vec<f64>,
}

impl Candidates {
    /// Places at the given spacing, and one more.
    pub(crate) fn along(cycle: &ClosedCurve, spacing: f64, also: Option<f64>) -> Self {
        let mut points = cycle.resampled(spacing.max(cycle.length() / MOST_CANDIDATES));
        let spacing = cycle.length() / points.len() as f64;
        let mut arcs: Vec<f64> = (0..points.len()).map(|k| k as f64 * spacing).collect();
        let walk = Walk::along(cycle);
        let n = cycle.segment_count();
        let mut segment = 0;
        let mut headings = Vec::with_capacity(points.len() + 1);
        for &arc in &arcs {
            while segment + 1 < n && cycle.arc_of(segment + 1) <= arc {
                segment += 1;
            }
            let end = if segment + 1 < n { cycle.arc_of(segment + 1) } else { cycle.length() };
            let length = end - cycle.arc_of(segment);
            let t = if length > 0.0 { ((arc - cycle.arc_of(segment)) / length).clamp(0.0, 1.0) } else { 0.0 };
            headings.push(walk.headings(&OnCurve { segment, t }));
        }
        if let Some(arc) = also.filter(|arc| arc.is_finite()) {
            let arc = cycle.wrapped(arc);
            arcs.push(arc);
            points.push(cycle.point_at(arc));
            headings.push(walk.headings(&cycle.locate(arc)));
        }
        Self { points, headings, arcs }
    }
}

/// Length and direction of every segment of a cycle.
struct Walk(Vec<(f64, DVec2)>);

impl Walk {
    fn along(cycle: &ClosedCurve) -> Self {
        let length_and_heading =
            |segment: Segment| (segment.length(), (segment.end - segment.start).normalize_or_zero());
        Self(cycle.segments().map(length_and_heading).collect())
    }

    /// The directions of the walk before and behind a place: two of the cycle's segments if it is at a vertex, else one.
    fn headings(&self, on: &OnCurve) -> Headings {
        let n = self.0.len();
        let (length, heading) = self.0[on.segment];
        let (begun, left) = (on.t * length, (1.0 - on.t) * length);
        let beside = |k: usize| self.0[k % n].1;
        Headings {
            arriving: if begun <= ON_VERTEX { beside(on.segment + n - 1) } else { heading },
            leaving: if left <= ON_VERTEX { beside(on.segment + 1) } else { heading },
        }
    }
}

/// A start of the layer below with the cost of the cheapest chain that ends there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reached {
    pub(crate) point: DVec2,
    pub(crate) arriving: DVec2,
    pub(crate) cost: f64,
    pub(crate) candidate: u32,
}

/// The starts of one layer that some chain reaches, sorted into cells, row by row, so that the starts in a
/// run of cells lie side by side in memory.
pub(crate) struct ReachedGrid {
    origin: DVec2,
    cells_per_mm: f64,
    /// The radius of a query in cells, and a little more, lest rounding lose a cell.
    radius_in_cells: f64,
    columns: usize,
    rows: usize,
    offsets: Vec<u32>,
    reached: Vec<Reached>,
}

impl ReachedGrid {
    /// A grid over the candidates whose cost is finite, for queries of radius `reach` mm.
    pub(crate) fn over(candidates: &Candidates, costs: &[f64], reach: f64) -> Self {
        let starts =
            || candidates.points.iter().zip(costs).enumerate().filter(|(_, (_, cost))| cost.is_finite());
        let (mut low, mut high, mut count) = (DVec2::INFINITY, DVec2::NEG_INFINITY, 0);
        for (_, (&point, _)) in starts() {
            low = low.min(point);
            high = high.max(point);
            count += 1;
        }
        if count == 0 {
            (low, high) = (DVec2::ZERO, DVec2::ZERO);
        }
        // Half the radius: five rows of cells cover a query and little beyond it.
        let most = (CELLS_PER_CANDIDATE * count + 1) as f64;
        let extent = high - low;
        let mut cell = (reach / 2.0).max(extent.max_element() / most).max(f64::MIN_POSITIVE);
        let cells = |cell: f64| (extent / cell).floor() + DVec2::ONE;
        while cells(cell).element_product() > most {
            cell *= 1.25;
        }
        let (columns, rows) = (cells(cell).x as usize, cells(cell).y as usize);
        let (origin, cells_per_mm) = (low, 1.0 / cell);
        let cell_of = |p: DVec2| {
            let at = (p - origin) * cells_per_mm;
            (at.y as usize).min(rows - 1) * columns + (at.x as usize).min(columns - 1)
        };
        let mut offsets = vec![0_u32; columns * rows + 1];
        for (_, (&point, _)) in starts() {
            offsets[cell_of(point) + 1] += 1;
        }
        for k in 1..offsets.len() {
            offsets[k] += offsets[k - 1];
        }
        let mut next = offsets.clone();
        let nobody = Reached { point: DVec2::ZERO, arriving: DVec2::ZERO, cost: 0.0, candidate: 0 };
        let mut reached = vec![nobody; count];
        for (k, (&point, &cost)) in starts() {
            let slot = &mut next[cell_of(point)];
            let arriving = candidates.headings[k].arriving;
            reached[*slot as usize] = Reached { point, arriving, cost, candidate: k as u32 };
            *slot += 1;
        }
        let radius_in_cells = reach * cells_per_mm + 1e-6;
        Self { origin, cells_per_mm, radius_in_cells, columns, rows, offsets, reached }
    }

    /// Visits every start in the cells within the radius of `p`; the caller measures.
    #[inline]
    pub(crate) fn for_each_near(&self, p: DVec2, mut visit: impl FnMut(&Reached)) {
        let at = (p - self.origin) * self.cells_per_mm;
        let (low, high) = (at - self.radius_in_cells, at + self.radius_in_cells);
        if !(high.x >= 0.0 && high.y >= 0.0 && low.x < self.columns as f64 && low.y < self.rows as f64) {
            return;
        }
        // Casts saturate, so what lies before the grid begins at its first cell.
        let (west, east) = (low.x as usize, (high.x as usize).min(self.columns - 1));
        for row in low.y as usize..=(high.y as usize).min(self.rows - 1) {
            let first = self.offsets[row * self.columns + west] as usize;
            let last = self.offsets[row * self.columns + east + 1] as usize;
            self.reached[first..last].iter().for_each(&mut visit);
        }
    }
}
