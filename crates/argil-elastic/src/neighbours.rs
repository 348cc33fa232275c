//! Which edges are near which vertices and edges, kept over several iterations.

use std::ops::Range;

use glam::DVec2;

use crate::rod::Rod;

/// How far any vertex may move before the lists are made anew, in w.
///
/// Just more than one capped step of the default options; the later steps are much shorter. Thicker, the lists
/// would last longer but fill with edges that are checked in vain; neither is dearer than the other around here.
const SKIN: f64 = 0.34;

/// Slack against rounding when a distance is compared with a list's reach, in w.
const ROUNDING: f64 = 1e-9;

/// Slack against rounding where an edge is cut at the rows of the grid, in buckets.
const CUTTING: f64 = 1e-6;

/// An edge that may repel a vertex, and the part of it that is far enough along the path to do so.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Opposite {
    pub(crate) edge: u32,
    pub(crate) from: f64,
    pub(crate) to: f64,
}

/// Neighbour lists with a skin, as molecular dynamics has them (Verlet lists).
///
/// The lists hold all pairs that can come within reach while no vertex has moved by more than the skin since they
/// were made. Nearest strands and crossings are then looked up at every trial step without touching the grid, and
/// since steps shrink as the relaxation settles, the lists are made two or three times and not twenty.
#[derive(Clone, Debug, Default)]
pub(crate) struct Neighbours {
    /// Where the vertices were when the lists were made, in w.
    reference: Vec<DVec2>,
    /// Middle and half the length of every edge at the reference.
    discs: Vec<(DVec2, f64)>,
    /// Per edge with a free end: edges that may come nearer than w to its first vertex, if that is free.
    opposite: Lists<Opposite>,
    /// Per edge with a free end: other edges that it may come to cross or to touch.
    crossable: Lists<u32>,
    grid: Grid,
}

/// A list for each of many owners, in one piece of memory.
#[derive(Clone, Debug)]
struct Lists<T> {
    starts: Vec<u32>,
    items: Vec<T>,
}

impl<T> Default for Lists<T> {
    fn default() -> Self {
        Self { starts: vec![0], items: Vec::new() }
    }
}

impl<T> Lists<T> {
    fn clear(&mut self) {
        self.starts.truncate(1);
        self.items.clear();
    }

    fn close(&mut self) {
        self.starts.push(self.items.len() as u32);
    }

    fn of(&self, owner: usize) -> &[T] {
        &self.items[self.starts[owner] as usize..self.starts[owner + 1] as usize]
    }
}

/// Reaches of the two kinds of list, in w.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reach {
    /// Distance below which strands repel each other; `None` if they do not.
    pub(crate) repulsion: Option<f64>,
    /// Arc length between places that may repel each other.
    pub(crate) skip: f64,
    /// Distance below which a strand touches a wall; `None` if neither touching nor crossing is of interest.
    pub(crate) touch: Option<f64>,
}

impl Neighbours {
    /// Forgets the lists: the next [`Self::cover`] makes them.
    pub(crate) fn forget(&mut self) {
        self.reference.clear();
    }

    /// Makes sure that the lists are complete for `points` (in w).
    pub(crate) fn cover(&mut self, rod: &Rod, points: &[DVec2], reach: &Reach) {
        let near = |(p, r): (&DVec2, &DVec2)| p.distance_squared(*r) <= SKIN * SKIN;
        if self.reference.len() == points.len() && points.iter().zip(&self.reference).all(near) {
            return;
        }
        self.reference.clear();
        self.reference.extend_from_slice(points);
        self.opposite.clear();
        self.crossable.clear();
        if reach.repulsion.is_none() && reach.touch.is_none() {
            return;
        }
        self.grid.fill(rod, points);
        let radius =
            |distance: Option<f64>| distance.map_or(f64::NEG_INFINITY, |d| d + 2.0 * SKIN + ROUNDING);
        let (repulsion, touch) = (radius(reach.repulsion), radius(reach.touch));
        self.discs.clear();
        self.discs.extend((0..points.len()).map(|k| {
            let (a, b) = (points[k], points[rod.next(k)]);
            (a.midpoint(b), 0.5 * a.distance(b))
        }));
        for &e in &rod.edges {
            let e = e as usize;
            let (a, b) = (points[e], points[rod.next(e)]);
            let (middle, half) = self.discs[e];
            let repelled = if rod.is_free(e) { repulsion } else { f64::NEG_INFINITY };
            let (opposite, crossable) = (&mut self.opposite.items, &mut self.crossable.items);
            let discs = &self.discs;
            // Negative where a fixed vertex is not repelled and crossings are of no interest: nothing is near then.
            self.grid.visit(a, b, repelled.max(touch), |k| {
                let (other, other_half) = discs[k];
                let near = repelled + other_half;
                if near >= 0.0
                    && other.distance_squared(a) <= near * near
                    && let Some((from, to)) = rod.part_beyond(e, k, reach.skip)
                {
                    opposite.push(Opposite { edge: k as u32, from, to });
                }
                // A pair of free edges is listed once; edges that share a vertex cannot cross properly.
                let near = touch + half + other_half;
                if near >= 0.0
                    && other.distance_squared(middle) <= near * near
                    && (k > e || !rod.edge_has_free_end(k))
                    && rod.edges_apart(e, k) > 1
                {
                    crossable.push(k as u32);
                }
            });
            self.opposite.close();
            self.crossable.close();
        }
    }

    /// The edges that may repel the first vertex of the edge at this place of [`Rod::edges`]; none if it is fixed.
    pub(crate) fn opposite(&self, place: usize) -> &[Opposite] {
        self.opposite.of(place)
    }

    /// The edges that the edge at this place of [`Rod::edges`] may cross or touch.
    pub(crate) fn crossable(&self, place: usize) -> &[u32] {
        self.crossable.of(place)
    }
}

/// The vector from the nearest point of segment `a`–`b` to `p`.
pub(crate) fn from_segment(p: DVec2, a: DVec2, b: DVec2) -> DVec2 {
    p - a.lerp(b, nearest_parameter(p, a, b).clamp(0.0, 1.0))
}

/// Where on the line through `a` and `b` the point nearest to `p` lies; 0 for a segment without length.
pub(crate) fn nearest_parameter(p: DVec2, a: DVec2, b: DVec2) -> f64 {
    let along = b - a;
    let square = along.length_squared();
    if square > 0.0 { (p - a).dot(along) / square } else { 0.0 }
}

/// Whether the bounding boxes of two segments come within `radius` of each other along both axes.
pub(crate) fn boxes_within(a: DVec2, b: DVec2, c: DVec2, d: DVec2, radius: f64) -> bool {
    let gap = (a.min(b) - c.max(d)).max(c.min(d) - a.max(b));
    gap.x <= radius && gap.y <= radius
}

/// Uniform buckets over the bounding box of the path; every edge is in all buckets that it may pass.
#[derive(Clone, Debug, Default)]
struct Grid {
    low: DVec2,
    cell: f64,
    columns: usize,
    rows: usize,
    starts: Vec<u32>,
    items: Vec<u32>,
    /// For every edge the last query that met it, so that an edge of many buckets is visited once.
    met: Vec<u32>,
    query: u32,
}

impl Grid {
    /// Sorts all edges into buckets of about one bead width.
    ///
    /// Buckets grow where the path is spread so thinly, or its edges are so long, that there would be more than some
    /// eight buckets or entries per vertex.
    fn fill(&mut self, rod: &Rod, points: &[DVec2]) {
        let n = points.len();
        let mut low = DVec2::INFINITY;
        let mut high = DVec2::NEG_INFINITY;
        for &p in points {
            low = low.min(p);
            high = high.max(p);
        }
        let extent = high - low;
        let most = 8.0 * n as f64 + 64.0;
        self.low = low;
        let (square, line) =
            ((extent.x * extent.y / most).sqrt(), extent.max_element().max(rod.perimeter) / most);
        self.cell = square.max(line).max(1.0);
        self.columns = (extent.x / self.cell) as usize + 1;
        self.rows = (extent.y / self.cell) as usize + 1;
        self.starts.clear();
        self.starts.resize(self.columns * self.rows + 1, 0);
        let mut starts = std::mem::take(&mut self.starts);
        for k in 0..n {
            self.each_row(points[k], points[rod.next(k)], 0.0, |row| {
                starts[row].iter_mut().for_each(|start| *start += 1);
            });
        }
        let mut total = 0;
        for start in &mut starts {
            total += *start;
            *start = total;
        }
        let mut items = std::mem::take(&mut self.items);
        items.clear();
        items.resize(total as usize, 0);
        // Filled from the back, which leaves every start where its bucket begins and edges in ascending order.
        for k in (0..n).rev() {
            self.each_row(points[k], points[rod.next(k)], 0.0, |row| {
                for start in &mut starts[row] {
                    *start -= 1;
                    items[*start as usize] = k as u32;
                }
            });
        }
        self.starts = starts;
        self.items = items;
        self.met.clear();
        self.met.resize(n, 0);
        self.query = 0;
    }

    /// Calls `found` once for every edge that may lie within `radius` of the segment `a`–`b`.
    fn visit(&mut self, a: DVec2, b: DVec2, radius: f64, mut found: impl FnMut(usize)) {
        if radius < 0.0 {
            return;
        }
        self.query += 1;
        let query = self.query;
        let mut met = std::mem::take(&mut self.met);
        self.each_row(a, b, radius, |row| {
            // The buckets of a row lie side by side, and so do their edges.
            for &k in &self.items[self.starts[row.start] as usize..self.starts[row.end] as usize] {
                if met[k as usize] != query {
                    met[k as usize] = query;
                    found(k as usize);
                }
            }
        });
        self.met = met;
    }

    /// Calls `found`, row by row, with the buckets that the segment `a`–`b`, widened by `radius`, may overlap.
    ///
    /// By rows, so that a long slanted edge fills the buckets along it and not its bounding box.
    fn each_row(&self, a: DVec2, b: DVec2, radius: f64, mut found: impl FnMut(Range<usize>)) {
        // Relative to the corner, so that a path far from the origin is cut as precisely as one at it.
        let (a, b) = (a - self.low, b - self.low);
        let (lower, upper) = if a.y <= b.y { (a, b) } else { (b, a) };
        let slope = (upper.x - lower.x) / (upper.y - lower.y);
        let steep = upper.y - lower.y > self.cell;
        for row in self.bucket(lower.y - radius, self.rows)..=self.bucket(upper.y + radius, self.rows) {
            let (mut left, mut right) = (lower.x.min(upper.x), lower.x.max(upper.x));
            if steep {
                let base = row as f64 * self.cell - radius - lower.y;
                let enter = lower.x + slope * base;
                let leave = lower.x + slope * (base + self.cell + 2.0 * radius);
                let slack = CUTTING * self.cell;
                left = left.max(enter.min(leave) - slack);
                right = right.min(enter.max(leave) + slack).max(left);
            }
            let base = row * self.columns;
            let first = base + self.bucket(left - radius, self.columns);
            found(first..base + self.bucket(right + radius, self.columns) + 1);
        }
    }

    /// Which of `count` rows or columns a distance from the corner falls into; the nearest if none.
    fn bucket(&self, from_corner: f64, count: usize) -> usize {
        ((from_corner / self.cell) as usize).min(count - 1)
    }
}
