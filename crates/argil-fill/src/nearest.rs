//! The nearest of many segments at every point of a grid.

use argil_curve::{DVec2, Segment};

use crate::plot::Plot;

/// No segment: a point outside, or one that no segment reaches.
pub(crate) const NONE: u32 = u32::MAX;

/// A segment as distances are measured from it many times, with one over its squared length.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line {
    start: DVec2,
    along: DVec2,
    scale: f64,
}

impl Line {
    pub(crate) fn of(segment: &Segment) -> Self {
        let along = segment.end - segment.start;
        let squared = along.length_squared();
        Self { start: segment.start, along, scale: if squared > 0.0 { 1.0 / squared } else { 0.0 } }
    }

    /// The square of the distance from `p`.
    #[inline]
    pub(crate) fn square(&self, p: DVec2) -> f64 {
        let away = p - self.start;
        let t = (away.dot(self.along) * self.scale).clamp(0.0, 1.0);
        (away - t * self.along).length_squared()
    }
}

/// The nearest segment, its site, at each point inside of a plot.
///
/// Sites write themselves to the points next to them, and points pass on to their neighbours what is nearest to them, in four sweeps
/// (Danielsson 1980, <https://doi.org/10.1016/0146-664X(80)90054-4>). Distances are exact for the site that is named; that another is
/// nearer by more than a hundredth of a step is rare.
#[derive(Debug)]
pub(crate) struct Nearest<'a> {
    pub(crate) plot: &'a Plot,
    pub(crate) sites: &'a [Segment],
    /// For each point its distance, mm, and its site; outside of the plot the distance is negative.
    distance: Vec<f64>,
    site: Vec<u32>,
    lines: Vec<Line>,
}

/// Sites write to points within so many steps.
const SEED: f64 = 1.5;

impl<'a> Nearest<'a> {
    /// # Complexity
    /// O(points + sites · their length in steps).
    pub(crate) fn new(plot: &'a Plot, sites: &'a [Segment]) -> Self {
        let points = plot.columns * plot.rows;
        let mut nearest = Self {
            plot,
            sites,
            distance: vec![-1.0; points],
            site: vec![NONE; points],
            lines: sites.iter().map(Line::of).collect(),
        };
        for &(row, first, last) in &plot.runs {
            let start = row * plot.columns;
            nearest.distance[start + first..=start + last].fill(f64::INFINITY);
        }
        nearest.seed();
        nearest.sweep();
        nearest
    }

    /// Distance from the nearest site, mm: infinite without sites, negative outside.
    pub(crate) fn distance(&self, column: usize, row: usize) -> f64 {
        if column < self.plot.columns && row < self.plot.rows {
            self.distance[row * self.plot.columns + column]
        } else {
            -1.0
        }
    }

    /// The number of the nearest site, or [`NONE`].
    pub(crate) fn site(&self, column: usize, row: usize) -> u32 {
        self.site[row * self.plot.columns + column]
    }

    /// The distances of all points, row by row.
    pub(crate) fn into_distances(self) -> Vec<f64> {
        self.distance
    }

    fn distance_to(&self, site: u32, column: usize, row: usize) -> f64 {
        self.lines[site as usize].square(self.plot.at(column, row)).sqrt()
    }

    fn seed(&mut self) {
        let plot = self.plot;
        let reach = SEED * plot.step;
        for (number, site) in (0_u32..).zip(self.sites) {
            let (from, to) = (site.start - plot.low, site.end - plot.low);
            for row in plot.between(from.y.min(to.y) - reach, from.y.max(to.y) + reach, plot.rows) {
                let (west, east) = extent(site, plot.low.y + row as f64 * plot.step, reach);
                for column in plot.between(west - plot.low.x, east - plot.low.x, plot.columns) {
                    let point = row * plot.columns + column;
                    if self.distance[point] > 0.0 {
                        self.take(point, column, row, number);
                    }
                }
            }
        }
    }

    #[inline]
    fn take(&mut self, point: usize, column: usize, row: usize, site: u32) {
        let distance = self.distance_to(site, column, row);
        if distance < self.distance[point] {
            self.distance[point] = distance;
            self.site[point] = site;
        }
    }

    /// Asks a neighbour for what is nearest to it.
    #[inline]
    fn ask(&mut self, point: usize, column: usize, row: usize, neighbour: usize, apart: f64) {
        let site = self.site[neighbour];
        // What is nearest to the neighbour is no nearer to this point than this.
        if site != self.site[point] && site != NONE && self.distance[neighbour] - apart < self.distance[point]
        {
            self.take(point, column, row, site);
        }
    }

    fn sweep(&mut self) {
        let plot = self.plot;
        let columns = plot.columns;
        let (side, diagonal) = (plot.step, std::f64::consts::SQRT_2 * plot.step);
        let up = plot.runs.iter().map(|&run| (run, true));
        let down = plot.runs.iter().rev().map(|&run| (run, false));
        for ((row, first, last), rising) in up.chain(down) {
            let start = row * columns;
            let behind = if rising { start - columns } else { start + columns };
            for column in first..=last {
                let point = start + column;
                self.ask(point, column, row, behind + column, side);
                self.ask(point, column, row, behind + column - 1, diagonal);
                self.ask(point, column, row, behind + column + 1, diagonal);
                self.ask(point, column, row, point - 1, side);
                if !rising {
                    self.descend(point, column, row);
                }
            }
            for column in (first..=last).rev() {
                let point = start + column;
                self.ask(point, column, row, point + 1, side);
            }
        }
    }

    /// Looks along the sites for nearer ones: those of one ring follow each other, and where many small ones meet, their
    /// points have no neighbour that knows them.
    fn descend(&mut self, point: usize, column: usize, row: usize) {
        let site = self.site[point];
        if site == NONE {
            return;
        }
        for up in [true, false] {
            let mut next = site;
            loop {
                next = if up { next.wrapping_add(1) } else { next.wrapping_sub(1) };
                if next as usize >= self.sites.len() {
                    break;
                }
                self.take(point, column, row, next);
                if self.site[point] != next {
                    break;
                }
            }
        }
    }
}

/// From where to where along x a segment has points within `reach` of height `y`, with room for its reach.
pub(crate) fn extent(segment: &Segment, y: f64, reach: f64) -> (f64, f64) {
    let (from, to) = (segment.start, segment.end);
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
    fn every_point_inside_has_its_distance() {
        // A frame, so that rows have one run or two.
        let mut sides = ring(&[(0.0, 0.0), (9.0, 1.0), (10.0, 8.0), (-1.0, 7.0)]);
        sides.extend(ring(&[(3.0, 3.0), (3.0, 5.0), (6.0, 5.0), (6.0, 3.0)]));
        let mut sites = sides.clone();
        sites.push(Segment::new(DVec2::new(2.0, 2.0), DVec2::new(2.0, 2.0)));
        let plot = Plot::new(&sides, 0.05).expect("it is small").expect("it has an inside");
        let nearest = Nearest::new(&plot, &sites);
        let (mut area, mut worst) = (0.0_f64, 0.0_f64);
        for row in 0..plot.rows {
            for column in 0..plot.columns {
                let distance = nearest.distance(column, row);
                if distance >= 0.0 {
                    let at = plot.at(column, row);
                    let truth = sites.iter().map(|s| s.distance(at)).fold(f64::INFINITY, f64::min);
                    worst = worst.max((distance - truth).abs());
                    area += 0.05 * 0.05;
                }
            }
        }
        assert!((area - (70.0 - 6.0)).abs() < 0.3, "{area}");
        assert!(worst < 0.02 * 0.05, "{worst}");
    }

    #[test]
    fn of_nothing() {
        let flat = ring(&[(0.0, 0.0), (1.0, 0.0)]);
        assert!(Plot::new(&flat, 0.1).expect("it is small").is_none());
        let square = ring(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]);
        let plot = Plot::new(&square, 0.1).expect("it is small").expect("it has an inside");
        assert!(Nearest::new(&plot, &[]).distance(5, 5).is_infinite());
        assert!(Plot::new(&square, 1e-5).is_err());
    }
}
