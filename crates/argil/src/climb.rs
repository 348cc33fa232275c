//! From planned cycles to the strand: where each layer begins, and the steps in between.

use argil_curve::{ClosedCurve, DVec2};
use argil_route::Leg;
use argil_strand::{Move, Role, Strand, StrandLayer, SupportSource};

use crate::descent::PlannedLayer;
use crate::stages::Seam;
use crate::{PlanError, Settings};

/// What a start on a wall costs against one on free strand, in w²: the seam shows on a wall, while clay that is cut
/// away hides it. A quarter of the longest step squared, so that it never outweighs a good chain.
const VISIBLE: f64 = 0.13;

/// Joins the cycles by a chain of starts.
pub(crate) fn strand(
    layers: &[PlannedLayer],
    seam: &mut impl Seam,
    settings: &Settings,
) -> Result<Strand, PlanError> {
    let cycles: Vec<ClosedCurve> = layers.iter().map(|layer| layer.curve.clone()).collect();
    let walls: Vec<argil_curve::SegmentIndex> =
        layers.iter().map(|layer| wall_segments(layer, settings.width)).collect();
    let cost = |k: usize, p: DVec2| {
        let on_wall = walls[k].nearest_within(p, 0.1 * settings.width).is_some();
        if on_wall { VISIBLE * settings.width * settings.width } else { 0.0 }
    };
    let starts = seam.starts(&cycles, settings, &cost)?;
    let mut strand_layers = Vec::with_capacity(layers.len());
    let mut first = None;
    for (layer, &start) in layers.iter().zip(&starts) {
        let (begin, mut moves) = opened(layer, start, settings.grid);
        match first {
            None => first = Some(begin),
            Some(_) => moves.insert(0, Move { to: begin, role: Role::Seam }),
        }
        let supports =
            layer.supports.iter().map(|s| SupportSource { at: s.position, needs: s.needs.clone() }).collect();
        strand_layers.push(StrandLayer {
            index: layer.report.index,
            z: layer.z,
            height: settings.layer_height,
            width: settings.width,
            moves,
            supports,
        });
    }
    Ok(Strand::new(first.unwrap_or_default(), strand_layers)?)
}

/// The wall stretches of a layer.
fn wall_segments(layer: &PlannedLayer, width: f64) -> argil_curve::SegmentIndex {
    let walls = layer.curve.segments().zip(&layer.legs).filter(|(_, leg)| **leg == Leg::Wall).map(|(s, _)| s);
    argil_curve::SegmentIndex::new(walls.collect(), width)
}

/// The cycle as moves from its start at the given arc back to it.
fn opened(layer: &PlannedLayer, start: f64, grid: f64) -> (DVec2, Vec<Move>) {
    let curve = &layer.curve;
    let points = curve.points();
    let n = points.len();
    let on = curve.locate(start);
    let exact = curve.point_at(start);
    let role = |k: usize| match layer.legs[k % n] {
        Leg::Wall => Role::Wall,
        Leg::Support => Role::Support,
        Leg::Joint => Role::Connection,
    };
    let near = |p: DVec2| p.distance(exact) <= 10.0 * grid;
    let (begin, first) = if near(points[on.segment]) {
        (points[on.segment], on.segment)
    } else if near(points[(on.segment + 1) % n]) {
        (points[(on.segment + 1) % n], on.segment + 1)
    } else {
        ((exact / grid).round() * grid, on.segment)
    };
    let mut moves: Vec<Move> =
        (0..n).map(|k| Move { to: points[(first + k + 1) % n], role: role(first + k) }).collect();
    if begin != points[first % n] {
        moves.push(Move { to: begin, role: role(first) });
    }
    (begin, moves)
}
