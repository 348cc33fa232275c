//! What the machine does between the first and the last bead: transfers, retractions, moves down, flow.

use crate::{Finding, FindingKind};
use argil_curve::DVec2;
use argil_gcode::{Move, Program};

/// A move shorter than this in the plane, mm, is no transfer: files round to 0.001.
const STANDS_STILL: f64 = 1e-3;
/// Less clay than this, in the file's unit, is none.
const NO_CLAY: f64 = 1e-9;
/// Less change of z than this, mm, is none.
const LEVEL: f64 = 1e-6;
/// The flow of moves shorter than this, mm, says more about rounding than about the flow.
const LONG_ENOUGH_FOR_FLOW: f64 = 0.05;

/// Kinds of moves whose names contain one of these belong to no layer's path.
const EXTRA: [&str; 3] = ["skirt", "prime", "purge"];
/// Kinds of moves whose names contain one of these fill floors, roofs and the inside.
const FILL: [&str; 6] = ["fill", "skin", "top", "bottom", "floor", "roof"];

/// One move of the file, in millimetres and the file's own unit of extrusion.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion {
    pub(crate) from: DVec2,
    pub(crate) to: DVec2,
    /// Height where it begins.
    pub(crate) z: f64,
    pub(crate) rise: f64,
    pub(crate) extruded: f64,
    pub(crate) layer: i64,
    /// Skirt, prime or purge: it counts for continuity alone.
    pub(crate) is_extra: bool,
    /// Floor, roof or infill: wall rules do not apply to it.
    pub(crate) is_fill: bool,
}

impl Motion {
    pub(crate) fn length(&self) -> f64 {
        self.from.distance(self.to)
    }

    /// Moves in the plane without laying clay.
    pub(crate) fn is_transfer(&self) -> bool {
        self.length() > STANDS_STILL && self.extruded <= NO_CLAY
    }
}

/// What [`measure`] counts.
#[derive(Clone, Debug, Default)]
pub(crate) struct Continuity {
    pub(crate) transfers: usize,
    pub(crate) transfer_length: f64,
    pub(crate) retractions: usize,
    pub(crate) moves_down: usize,
    /// Clay a millimetre: median, first and ninety-ninth percentile.
    pub(crate) flow: Option<[f64; 3]>,
}

/// The moves from the first to the last that lay clay: what comes before and after is no part of the print.
///
/// Layers are those that the comments tell. A file without such comments has them by the height where a move
/// ends.
pub(crate) fn motions(program: &Program, layer_height: f64) -> Vec<Motion> {
    let says = |kind: &str, words: &[&str]| {
        let kind = kind.to_lowercase();
        words.iter().any(|word| kind.contains(word))
    };
    let is_extra: Vec<bool> = program.kinds.iter().map(|k| says(k, &EXTRA)).collect();
    let is_fill: Vec<bool> = program.kinds.iter().map(|k| says(k, &FILL)).collect();
    let of_kind = |marks: &[bool], m: &Move| m.kind.and_then(|k| marks.get(k).copied()).unwrap_or(false);
    let says_layers = program.moves.iter().any(|m| m.layer.is_some());
    let layer_of = |m: &Move| match m.layer {
        Some(layer) => layer,
        None if says_layers => -1,
        // The cast saturates.
        None => (m.to[2] / layer_height).round_ties_even() as i64,
    };
    program
        .strand_moves()
        .iter()
        .map(|m| Motion {
            from: DVec2::new(m.from[0], m.from[1]),
            to: DVec2::new(m.to[0], m.to[1]),
            z: m.from[2],
            rise: m.to[2] - m.from[2],
            extruded: m.extruded,
            layer: layer_of(m),
            is_extra: of_kind(&is_extra, m),
            is_fill: of_kind(&is_fill, m),
        })
        .collect()
}

/// Counts every break of the strand; transfers that follow one another directly are one.
pub(crate) fn measure(motions: &[Motion], findings: &mut Vec<Finding>) -> Continuity {
    let mut continuity = Continuity::default();
    let mut flow = Vec::new();
    let mut underway: Option<usize> = None;
    for m in motions {
        let found = |kind, measure| Finding { kind, layer: m.layer, at: Some(m.from), measure };
        if m.is_transfer() {
            continuity.transfer_length += m.length();
            match underway {
                Some(k) => findings[k].measure += m.length(),
                None => {
                    continuity.transfers += 1;
                    underway = Some(findings.len());
                    findings.push(found(FindingKind::Transfer, m.length()));
                }
            }
        } else {
            underway = None;
        }
        if m.extruded < -NO_CLAY {
            continuity.retractions += 1;
            findings.push(found(FindingKind::Retraction, -m.extruded));
        }
        if m.rise < -LEVEL {
            continuity.moves_down += 1;
            findings.push(found(FindingKind::MoveDown, -m.rise));
        }
        if m.length() > LONG_ENOUGH_FOR_FLOW && !m.is_transfer() {
            flow.push(m.extruded / m.length());
        }
    }
    flow.sort_by(f64::total_cmp);
    continuity.flow = percentile(&flow, 0.5)
        .zip(percentile(&flow, 0.01))
        .zip(percentile(&flow, 0.99))
        .map(|((median, low), high)| [median, low, high]);
    continuity
}

/// The value below which the given share of the sorted values lies, between neighbours by proportion.
fn percentile(sorted: &[f64], share: f64) -> Option<f64> {
    let last = sorted.len().checked_sub(1)?;
    let at = share * last as f64;
    let below = at.floor() as usize;
    let above = (below + 1).min(last);
    Some(sorted[below] + (at - below as f64) * (sorted[above] - sorted[below]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_lie_between_neighbours() {
        assert_eq!(percentile(&[], 0.5), None);
        assert_eq!(percentile(&[7.0], 0.99), Some(7.0));
        assert_eq!(percentile(&[0.0, 1.0, 2.0, 4.0], 0.5), Some(1.5));
    }
}
