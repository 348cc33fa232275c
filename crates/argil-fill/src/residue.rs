//! Strips that stay bare between rings, and the loops there and back that fill them.

use argil_curve::DVec2;

use crate::FillOptions;
use crate::bare::summit;
use crate::contour::{Spot, contours};
use crate::nearest::{Line, NONE, Nearest};
use crate::ring::ring_on_grid;

/// The loop runs inside of its part by this share of the part's width, and by at most so much in w: both lanes then lie as far
/// apart as they can without laying clay far outside of the strip.
const INSET: f64 = 0.3;
const MOST_INSET: f64 = 0.25;
const LEAST_INSET: f64 = 0.05;

/// Half of what is thinner than any loop, in w.
const SLIGHT: f64 = 0.02;

/// Shorter loops are blobs, in w.
const LEAST_LENGTH: f64 = 0.5;

/// How often finer than the plot loops are drawn.
const FINER: usize = 3;

/// Loops for what the rings, which are the sites of `nearest`, leave bare.
///
/// # Complexity
/// O(points of the plot), and four times as many where something is bare.
pub(crate) fn strips(nearest: &Nearest<'_>, options: &FillOptions) -> Vec<Vec<DVec2>> {
    let parts = Parts::found(nearest, options);
    let levels: Vec<f64> = (0..parts.count).map(|part| parts.level(part, options)).collect();
    let fine = Fine::over(&parts, &levels);
    let step = nearest.plot.step / FINER as f64;
    let corners = |column, row| {
        let spot = |column, row| fine.spot(column, row);
        let [low, east] = [spot(column, row)?, spot(column + 1, row)?];
        Some([low, east, spot(column + 1, row + 1)?, spot(column, row + 1)?])
    };
    let distance = |column, row| fine.spot(column, row).map_or(0.0, |spot| spot.distance);
    let lines = contours(fine.cells(), nearest.sites, step, SLIGHT * options.width, corners, distance);
    lines
        .into_iter()
        .filter_map(|(_, points)| {
            ring_on_grid(points, options.width, options.grid, LEAST_LENGTH * options.width)
        })
        .collect()
}

/// Bare parts of a plot, each with the points next to it.
struct Parts<'a> {
    nearest: &'a Nearest<'a>,
    count: u32,
    /// For each point of the plot the part that it belongs or is next to, or [`NONE`].
    part: Vec<u32>,
    /// Their points, part by part, as column and row.
    points: Vec<(usize, usize)>,
    /// Where the points of each part begin.
    begins: Vec<usize>,
}

impl<'a> Parts<'a> {
    /// The bare parts into which a disc as wide as the option says may fit.
    fn found(nearest: &'a Nearest<'a>, options: &FillOptions) -> Self {
        let plot = nearest.plot;
        let w = options.width;
        let is_bare = |column, row| nearest.distance(column, row) > 0.5 * w;
        let wide = 0.5 * (w + options.residue * w) - std::f64::consts::FRAC_1_SQRT_2 * plot.step;
        let mut parts = Self {
            nearest,
            count: 0,
            part: vec![NONE; plot.columns * plot.rows],
            points: Vec::new(),
            begins: Vec::new(),
        };
        for &(row, first, last) in &plot.runs {
            for column in first..=last {
                let point = row * plot.columns + column;
                let distance = nearest.distance(column, row);
                if distance < wide.max(0.5 * w) || distance.is_infinite() || parts.part[point] != NONE {
                    continue;
                }
                let begin = parts.points.len();
                parts.begins.push(begin);
                parts.part[point] = parts.count;
                parts.points.push((column, row));
                let mut next = begin;
                while next < parts.points.len() {
                    let (column, row) = parts.points[next];
                    next += 1;
                    if !is_bare(column, row) {
                        continue;
                    }
                    for (column, row) in around(column, row, 1) {
                        let point = row * plot.columns + column;
                        if parts.part[point] == NONE && nearest.distance(column, row) >= 0.0 {
                            parts.part[point] = parts.count;
                            parts.points.push((column, row));
                        }
                    }
                }
                parts.count += 1;
            }
        }
        parts
    }

    fn of(&self, part: u32) -> &[(usize, usize)] {
        let end = self.begins.get(part as usize + 1).copied().unwrap_or(self.points.len());
        &self.points[self.begins[part as usize]..end]
    }

    /// The distance from the rings at which a part has its loop; infinite for one that is too narrow.
    fn level(&self, part: u32, options: &FillOptions) -> f64 {
        let w = options.width;
        let nearest = self.nearest;
        let distance = |&(column, row): &(usize, usize)| nearest.distance(column, row);
        let top = self.of(part).iter().max_by(|a, b| distance(a).total_cmp(&distance(b)));
        let Some(&(column, row)) = top else { return f64::INFINITY };
        let mut near: Vec<u32> = within(nearest, column, row, 3).collect();
        near.sort_unstable();
        near.dedup();
        let near: Vec<Line> = near.into_iter().map(|site| Line::of(&nearest.sites[site as usize])).collect();
        let (_, distance) = summit(nearest.plot.at(column, row), &near, w, 0.5 * w);
        let diameter = 2.0 * distance - w;
        if diameter < options.residue * w {
            return f64::INFINITY;
        }
        0.5 * w + (INSET * diameter).clamp(LEAST_INSET * w, MOST_INSET * w)
    }
}

/// The points up to `reach` away in either direction; those beyond the low border are left out.
fn around(column: usize, row: usize, reach: usize) -> impl Iterator<Item = (usize, usize)> {
    let columns = column.saturating_sub(reach)..=column + reach;
    (row.saturating_sub(reach)..=row + reach).flat_map(move |row| columns.clone().map(move |c| (c, row)))
}

/// The sites that are nearest to the points about one.
fn within(nearest: &Nearest<'_>, column: usize, row: usize, reach: usize) -> impl Iterator<Item = u32> {
    let plot = nearest.plot;
    let points = around(column, row, reach).filter(|&(c, r)| c < plot.columns && r < plot.rows);
    points.map(|(column, row)| nearest.site(column, row)).filter(|&site| site != NONE)
}

/// A finer grid, of the points of parts only.
struct Fine<'a> {
    parts: &'a Parts<'a>,
    /// For each point of the plot where its finer points begin, or [`NONE`].
    begins: Vec<u32>,
    /// Finer points, row by row for each point of the plot.
    spots: Vec<Spot>,
}

impl<'a> Fine<'a> {
    fn over(parts: &'a Parts<'a>, levels: &[f64]) -> Self {
        let nearest = parts.nearest;
        let plot = nearest.plot;
        let mut fine = Self { parts, begins: vec![NONE; plot.columns * plot.rows], spots: Vec::new() };
        let mut near: Vec<u32> = Vec::new();
        for part in (0..parts.count).filter(|&part| levels[part as usize].is_finite()) {
            for &(column, row) in parts.of(part) {
                fine.begins[row * plot.columns + column] = fine.spots.len() as u32;
                near.clear();
                near.extend(within(nearest, column, row, 1));
                near.sort_unstable();
                near.dedup();
                for k in 0..FINER * FINER {
                    let shift = DVec2::new((k % FINER) as f64, (k / FINER) as f64) / FINER as f64;
                    let at = plot.at(column, row) + plot.step * shift;
                    let distances =
                        near.iter().map(|&site| (nearest.sites[site as usize].distance(at), site));
                    let least = distances.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
                    let (distance, site) = least.unwrap_or((0.0, NONE));
                    fine.spots.push(Spot { at, distance, site, level: levels[part as usize] });
                }
            }
        }
        fine
    }

    /// The low corners of all cells, row by row for each point of the plot.
    fn cells(&self) -> impl Iterator<Item = (usize, usize)> {
        let drawn =
            self.parts.points.iter().filter(|&&(column, row)| {
                self.begins[row * self.parts.nearest.plot.columns + column] != NONE
            });
        drawn.flat_map(|&(column, row)| {
            (0..FINER * FINER).map(move |k| (FINER * column + k % FINER, FINER * row + k / FINER))
        })
    }

    fn spot(&self, column: usize, row: usize) -> Option<Spot> {
        let point = (row / FINER) * self.parts.nearest.plot.columns + column / FINER;
        let begin = self.begins.get(point).copied().filter(|&begin| begin != NONE)? as usize;
        Some(self.spots[begin + (row % FINER) * FINER + column % FINER])
    }
}
