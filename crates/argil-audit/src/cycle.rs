//! From moves to layers of paths, and where the cycle of a layer begins.

use crate::motion::Motion;
use crate::settings::Tolerance;
use argil_curve::DVec2;
use std::collections::BTreeMap;

/// A move shorter than this, mm, adds no point to a path.
const SAME_POINT: f64 = 1e-6;

/// A polyline along which clay is laid without a break.
#[derive(Clone, Debug)]
pub(crate) struct Path {
    pub(crate) points: Vec<DVec2>,
    /// The height of the nozzle at each point, mm.
    pub(crate) heights: Vec<f64>,
    /// Whether the segment from point k to point k + 1 is floor, roof or infill.
    pub(crate) fill: Vec<bool>,
}

/// The paths of every layer that has any, by the layer's number in the file.
///
/// A transfer ends a path; nothing else does, so a file that returns to an earlier layer shows as a long
/// segment.
pub(crate) fn layers(motions: &[Motion]) -> BTreeMap<i64, Vec<Path>> {
    let mut layers: BTreeMap<i64, (Vec<Path>, bool)> = BTreeMap::new();
    for m in motions.iter().filter(|m| m.length() > SAME_POINT && !m.is_extra) {
        let (paths, underway) = layers.entry(m.layer).or_default();
        if m.is_transfer() {
            *underway = false;
            continue;
        }
        if !*underway {
            paths.push(Path { points: vec![m.from], heights: vec![m.z], fill: Vec::new() });
            *underway = true;
        }
        if let Some(path) = paths.last_mut() {
            path.points.push(m.to);
            path.heights.push(m.z + m.rise);
            path.fill.push(m.is_fill);
        }
    }
    layers
        .into_iter()
        .filter_map(|(k, (paths, _))| if paths.is_empty() { None } else { Some((k, paths)) })
        .collect()
}

/// Where the cycle of a layer begins: after a short step from the end of the layer below.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CycleStart {
    /// Whether the layer's path comes back to its beginning.
    pub(crate) closed: bool,
    /// The beginning itself; the first point of the layer when it is not closed.
    pub(crate) at: DVec2,
    /// Length of the step before it, mm.
    pub(crate) step_up: f64,
}

/// Looks for the beginning of the cycle in the first stretch of the layer: the first place that the layer's
/// end comes back to. `None` for a layer without a path.
pub(crate) fn cycle_start(paths: &[Path], tolerance: &Tolerance) -> Option<CycleStart> {
    let end = *paths.last()?.points.last()?;
    let first = paths.first()?.points.first()?;
    let mut run = 0.0;
    if first.distance(end) <= tolerance.closed {
        return Some(CycleStart { closed: true, at: *first, step_up: run });
    }
    for pair in paths.first()?.points.windows(2) {
        let length = pair[0].distance(pair[1]);
        let pieces = (length / tolerance.head_step).ceil().max(1.0);
        let mut piece = 0.0;
        while piece < pieces {
            run += length / pieces;
            if run > tolerance.head {
                return Some(CycleStart { closed: false, at: *first, step_up: 0.0 });
            }
            let at = pair[0].lerp(pair[1], (piece + 0.5) / pieces);
            if at.distance(end) <= tolerance.closed {
                return Some(CycleStart { closed: true, at, step_up: run });
            }
            piece += 1.0;
        }
    }
    Some(CycleStart { closed: false, at: *first, step_up: 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(points: &[(f64, f64)]) -> Path {
        let heights = vec![0.5; points.len()];
        Path {
            points: points.iter().map(|&p| p.into()).collect(),
            heights,
            fill: vec![false; points.len() - 1],
        }
    }

    #[test]
    fn the_step_is_no_part_of_the_cycle() {
        let tolerance = Tolerance::for_width(1.5);
        let square = path(&[(-0.8, 0.0), (0.0, 0.0), (5.0, 0.0), (5.0, 5.0), (0.0, 5.0), (0.0, 0.0)]);
        let start = cycle_start(&[square], &tolerance).unwrap();
        assert!(start.closed && start.at.distance(DVec2::ZERO) <= tolerance.closed);
        assert!((start.step_up - 0.8).abs() < 0.1, "{start:?}");
    }

    #[test]
    fn an_open_layer_begins_at_its_first_point() {
        let start = cycle_start(&[path(&[(0.0, 0.0), (9.0, 0.0), (9.0, 9.0)])], &Tolerance::for_width(1.5));
        assert!(start.is_some_and(|s| !s.closed && s.at == DVec2::ZERO && s.step_up == 0.0));
        assert!(cycle_start(&[], &Tolerance::for_width(1.5)).is_none());
    }
}
