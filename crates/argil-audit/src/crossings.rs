//! Where a path crosses itself.

use crate::cycle::{CycleStart, Path};
use crate::settings::Tolerance;
use argil_curve::{Crossing, CrossingKind, DVec2, self_crossings};

/// Steps shorter than this, mm, are rounding: they would turn the ends at a shared vertex about.
const NO_STEP: f64 = 1e-6;

/// The places where stretches of a path go through one another: segments that cross properly, and, for a
/// layer that is one closed cycle, vertices that two stretches share with alternating ends.
pub(crate) fn crossings(paths: &[Path], start: &CycleStart, tolerance: &Tolerance) -> Vec<DVec2> {
    let mut found: Vec<DVec2> = paths.iter().flat_map(|path| proper(&path.points)).collect();
    if let [path] = paths
        && start.closed
    {
        found.extend(at_vertices(&path.points, start, tolerance));
    }
    found
}

fn proper(points: &[DVec2]) -> impl Iterator<Item = DVec2> {
    let closing = points.len().saturating_sub(1);
    self_crossings(points)
        .into_iter()
        // A path is open: the segment that would close it was never printed.
        .filter(move |c: &Crossing| {
            c.kind == CrossingKind::Proper && c.first != closing && c.second != closing
        })
        .map(|c| c.point)
}

/// The step up from the layer below is no part of the cycle; its end would count as a fourth strand at the
/// seam.
fn at_vertices(points: &[DVec2], start: &CycleStart, tolerance: &Tolerance) -> impl Iterator<Item = DVec2> {
    let mut cycle: Vec<DVec2> = Vec::with_capacity(points.len() + 1);
    if start.step_up > tolerance.step_up {
        let mut run = 0.0;
        let passed = points.windows(2).take_while(|pair| {
            run += pair[0].distance(pair[1]);
            run < start.step_up - tolerance.step_up
        });
        let skip = passed.count() + 1;
        cycle.push(start.at);
        cycle.extend(points.iter().skip(skip));
    } else {
        cycle.extend(points);
    }
    let kept: Vec<DVec2> =
        cycle.windows(2).filter(|pair| pair[0].distance(pair[1]) > NO_STEP).map(|pair| pair[0]).collect();
    self_crossings(&kept).into_iter().filter(|c| c.kind == CrossingKind::AtVertex).map(|c| c.point)
}
