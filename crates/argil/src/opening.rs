//! A cycle as moves that begin and end at its start.

use argil_curve::{DVec2, Segment, on_grid, self_crossings};
use argil_route::Leg;
use argil_strand::{Move, Role};

use crate::descent::PlannedLayer;

/// Vertices no farther apart than this are one place, mm.
const ON_VERTEX: f64 = 2e-4;

/// A layer opened at its start: the place, and the moves from there back to it.
pub(crate) type Opened = (DVec2, Vec<Move>);

/// The stretches of an opened cycle, from its start back to it.
pub(crate) fn stretches((begin, moves): &Opened) -> Vec<Segment> {
    let ends = std::iter::once(*begin).chain(moves.iter().map(|m| m.to));
    ends.zip(moves).map(|(start, m)| Segment::new(start, m.to)).collect()
}

/// The same the other way round.
pub(crate) fn turned((begin, moves): &Opened) -> Opened {
    let from = moves.iter().rev().skip(1).map(|m| m.to).chain([*begin]);
    (*begin, from.zip(moves.iter().rev()).map(|(to, m)| Move { to, role: m.role }).collect())
}

/// Whether a step crosses none of the stretches that it leads to.
pub(crate) fn is_clear(step: &Segment, stretches: &[Segment]) -> bool {
    !stretches.iter().any(|stretch| stretch.crosses(step))
}

/// Whether a cycle crosses itself nowhere if it begins at a place that is not quite its own: one that is cut in two on the grid may, where
/// another stretch touches it. All the rest of it is known to be sound.
pub(crate) fn is_simple(begin: DVec2, stretches: &[Segment]) -> bool {
    let [first, .., last] = stretches else { return true };
    let (first, last) = (Segment::new(begin, first.end), Segment::new(last.start, begin));
    let between = &stretches[1..stretches.len() - 1];
    let others = |p: DVec2| between.iter().filter(|s| s.start.distance(p) <= ON_VERTEX).count();
    if !is_clear(&first, between) || !is_clear(&last, between) {
        return false;
    }
    // The first vertex behind the start is one of those between.
    if others(first.end) <= 1 && others(begin) == 0 && others(last.start) == 0 {
        return true;
    }
    let points: Vec<DVec2> = stretches.iter().skip(1).map(|s| s.start).chain([begin]).collect();
    self_crossings(&points).is_empty()
}

/// The cycle as moves from its start at the given arc back to it.
pub(crate) fn opened(layer: &PlannedLayer, start: f64, grid: f64) -> Opened {
    let curve = &layer.curve;
    let points = curve.points();
    let n = points.len();
    let on = curve.locate(start);
    let exact = curve.point_at(start);
    let role = |k: usize| match layer.legs[k % n] {
        Leg::Wall if layer.fill[k % n] => Role::Fill,
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
        (on_grid(exact, grid), on.segment)
    };
    let mut moves: Vec<Move> =
        (0..n).map(|k| Move { to: points[(first + k + 1) % n], role: role(first + k) }).collect();
    if begin != points[first % n] {
        moves.push(Move { to: begin, role: role(first) });
    }
    (begin, moves)
}
