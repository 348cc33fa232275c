//! Flow by the local width: each stretch lays the clay of what is nearest to it.

use argil_curve::{Segment, SegmentIndex};

use crate::curve::Bead;
use crate::nearest::Nearest;
use crate::plot::Plot;
use crate::rings::Core;
use crate::{FillCurve, FillError};

/// Rooms are evened out over so much of the curve to either side, in w: a grid of points says little about a short stretch.
const EVEN: f64 = 1.0;

/// The grid on which rooms are measured is so much finer than that of the rings.
const FINER: f64 = 2.0;

/// A stretch this near to the edge of a core, in w, is its outermost ring, whose outer half lies outside of the core.
const AT_EDGE: f64 = 0.1;

/// Areas with beads that follow the room they have, mm².
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Laid {
    /// Area of the cores that lies under no bead.
    pub(crate) bare: f64,
    /// Area of all beads, one beside the other.
    pub(crate) beads: f64,
}

/// Sets the flow of all stretches that are no wall within `limits`, which are shares of the width, and tells what then is laid.
///
/// A point that no wall's bead covers belongs to the nearest other stretch within its widest bead; a stretch lays what belongs to it
/// and to its neighbours along the curve, evened out; more than a full width only where either side has room for it.
///
/// # Errors
/// [`FillError::TooLarge`]
///
/// # Complexity
/// O(points of the cores + vertices · vertices within a width of them).
pub(crate) fn follow_room(
    curves: &mut [FillCurve],
    cores: &[Core],
    width: f64,
    limits: [f64; 2],
) -> Result<Laid, FillError> {
    let mut walls: Vec<Segment> = Vec::new();
    let mut fills: Vec<Segment> = Vec::new();
    for curve in &*curves {
        for (segment, bead) in curve.stretches() {
            if matches!(bead, Bead::Wall(_)) { walls.push(segment) } else { fills.push(segment) }
        }
    }
    let [least, most] = limits;
    // To the left and to the right of each stretch.
    let mut room = vec![[0.0; 2]; fills.len()];
    let plots = finer(cores)?;
    let near: Vec<[Nearest<'_>; 2]> =
        plots.iter().map(|plot| [Nearest::new(plot, &walls), Nearest::new(plot, &fills)]).collect();
    for [wall, fill] in &near {
        for_each_point(wall, |column, row, area| {
            let site = fill.site(column, row) as usize;
            let reached = fill.distance(column, row) <= 0.5 * most * width;
            if let Some(stretch) = fills.get(site)
                && reached
                && wall.distance(column, row) > 0.5 * width
            {
                let at = fill.plot.at(column, row);
                let left = (stretch.end - stretch.start).perp_dot(at - stretch.start) > 0.0;
                room[site][usize::from(!left)] += area;
            }
        });
    }
    for core in cores {
        let edge = SegmentIndex::new(core.sides.clone(), width);
        for (segment, room) in fills.iter().zip(&mut room) {
            if edge.is_within(segment.point_at(0.5), AT_EDGE * width) {
                let outer = usize::from(room[1] < room[0]);
                room[outer] += 0.5 * width * segment.length();
            }
        }
    }
    let mut first = 0;
    for curve in &mut *curves {
        let count = curve.beads.iter().filter(|bead| !matches!(bead, Bead::Wall(_))).count();
        evened(curve, &room[first..first + count], width, [least, most]);
        first += count;
    }
    let flows: Vec<f64> = curves
        .iter()
        .flat_map(|curve| curve.beads.iter().zip(&curve.flow))
        .filter(|(bead, _)| !matches!(bead, Bead::Wall(_)))
        .map(|(_, &flow)| flow)
        .collect();
    let mut laid = Laid::default();
    for [wall, fill] in &near {
        for_each_point(wall, |column, row, area| {
            let flow = flows.get(fill.site(column, row) as usize).copied().unwrap_or(0.0);
            let beyond = (wall.distance(column, row) - 0.5 * width)
                .min(fill.distance(column, row) - 0.5 * flow * width);
            // A point stands for half a step to either side.
            laid.bare += area * (beyond / (0.5 * wall.plot.step)).clamp(0.0, 1.0);
        });
    }
    laid.beads = curves
        .iter()
        .flat_map(|curve| curve.stretches().zip(&curve.flow))
        .map(|((segment, _), flow)| segment.length() * flow * width)
        .sum();
    Ok(laid)
}

/// Finer grids over the same cores.
fn finer(cores: &[Core]) -> Result<Vec<Plot>, FillError> {
    let plots = cores.iter().map(|core| Plot::new(&core.sides, core.plot.step / FINER));
    Ok(plots.collect::<Result<Vec<_>, _>>()?.into_iter().flatten().collect())
}

/// Visits the points inside of a plot with the area that each stands for.
fn for_each_point(nearest: &Nearest<'_>, mut visit: impl FnMut(usize, usize, f64)) {
    let plot = nearest.plot;
    for &(row, first, last) in &plot.runs {
        for column in first..=last {
            visit(column, row, plot.step * plot.step);
        }
    }
}

/// Sets the flow of a curve from the room that each of its stretches has that are no wall.
fn evened(curve: &mut FillCurve, room: &[[f64; 2]], width: f64, [least, most]: [f64; 2]) {
    let n = curve.points.len();
    let mut rooms = room.iter().copied();
    // Length and room of each stretch; none for a wall.
    let stretches: Vec<Option<(f64, [f64; 2])>> = curve
        .stretches()
        .map(|(segment, bead)| match bead {
            Bead::Wall(_) => None,
            _ => Some((segment.length(), rooms.next().unwrap_or_default())),
        })
        .collect();
    curve.flow = (0..n)
        .map(|k| {
            let Some((own, mut area)) = stretches[k] else { return 1.0 };
            let mut length = own;
            for ahead in [true, false] {
                let mut gone = 0.0;
                for step in 1..n {
                    let other = if ahead { (k + step) % n } else { (k + n - step) % n };
                    let Some((more, room)) = stretches[other].filter(|_| gone < EVEN * width) else { break };
                    gone += more;
                    length += more;
                    area = [area[0] + room[0], area[1] + room[1]];
                }
            }
            let [left, right] = area.map(|side| side / (length * width));
            let flow = if left + right <= 1.0 { left + right } else { (2.0 * left.min(right)).max(1.0) };
            // Without length nothing is laid.
            if flow.is_finite() { flow.clamp(least, most) } else { 1.0 }
        })
        .collect();
}
