//! In which order a layer's walls are laid.

use argil_curve::{ClosedCurve, DVec2, Segment, SegmentIndex};
use argil_route::Leg;
use argil_slice::Layer;

use crate::descent::PlannedLayer;
use crate::opening::{Opened, opened, turned};
use crate::settings::{Settings, WallOrder};

/// Strand of a wall lies no farther from that wall's path, in w.
const ON_WALL: f64 = 0.05;

/// What it costs to begin where all walls come in the wrong order, in w²: more than the longest step, since every layer begins anew.
const WRONG: f64 = 2.0;

/// How far the outer walls of a cycle come before its other walls, for every place where it may begin.
pub(crate) struct Precedence {
    sides: SegmentIndex,
    /// If the cycle begins at a vertex: of all pairs of a piece of outer wall and a piece of another wall the share in which the outer
    /// one comes first. From vertex to vertex it changes evenly, since a piece goes from the first place to the last.
    ahead: Vec<f64>,
    order: WallOrder,
}

impl Precedence {
    /// What an order that is asked for means in a layer; `None` where none is, or where there is but one kind of wall.
    ///
    /// # Complexity
    /// Near linear in the points of the layer.
    pub(crate) fn of(layer: &PlannedLayer, slice: &Layer, settings: &Settings) -> Option<Self> {
        if settings.wall_order == WallOrder::Any {
            return None;
        }
        let walls = WallPaths::of(slice, settings.width);
        let kinds: Vec<Option<Kind>> = layer
            .curve
            .segments()
            .enumerate()
            .map(
                |(k, side)| {
                    if layer.legs[k] == Leg::Wall && !layer.fill[k] { walls.kind(side) } else { None }
                },
            )
            .collect();
        let ahead = shares(&layer.curve, &kinds)?;
        let sides = SegmentIndex::of_curves([&layer.curve], settings.width);
        Some(Self { sides, ahead, order: settings.wall_order })
    }

    /// The share of the outer walls that lies ahead of the others, if the cycle begins at this place of it and is laid as it runs.
    fn ahead(&self, begin: DVec2) -> f64 {
        let Some(nearest) = self.sides.nearest(begin) else { return 0.0 };
        let (k, n) = (nearest.index, self.ahead.len());
        let t = self.sides.segments()[k].nearest(begin).t;
        self.ahead[k] + t * (self.ahead[(k + 1) % n] - self.ahead[k])
    }

    /// Whether the cycle that begins here is to be laid the other way round.
    fn is_turned(&self, begin: DVec2) -> bool {
        (self.ahead(begin) < 0.5) == (self.order == WallOrder::OuterFirst)
    }

    /// The share of the outer walls that is laid ahead of the others.
    pub(crate) fn laid_ahead(&self, begin: DVec2) -> f64 {
        let ahead = self.ahead(begin);
        if self.is_turned(begin) { 1.0 - ahead } else { ahead }
    }

    /// What it costs to begin here, the better way round, in w².
    pub(crate) fn cost(&self, begin: DVec2) -> f64 {
        let ahead = self.ahead(begin);
        WRONG * ahead.min(1.0 - ahead)
    }
}

/// The cycle as moves from its start at the given arc back to it, the way round that brings its walls into their order.
pub(crate) fn opened_in_order(
    layer: &PlannedLayer,
    start: f64,
    order: Option<&Precedence>,
    grid: f64,
) -> Opened {
    let opened = opened(layer, start, grid);
    if order.is_some_and(|order| order.is_turned(opened.0)) { turned(&opened) } else { opened }
}

/// Which wall of its outline a stretch belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Outer,
    Other,
}

/// The paths of all walls of a layer.
struct WallPaths {
    index: SegmentIndex,
    kinds: Vec<Kind>,
    near: f64,
}

impl WallPaths {
    fn of(slice: &Layer, width: f64) -> Self {
        let (mut sides, mut kinds) = (Vec::new(), Vec::new());
        for wall in &slice.walls {
            let n = wall.points.len();
            sides.extend((0..n).map(|k| Segment::new(wall.points[k], wall.points[(k + 1) % n])));
            kinds.resize(sides.len(), if wall.wall == 0 { Kind::Outer } else { Kind::Other });
        }
        Self { index: SegmentIndex::new(sides, width), kinds, near: ON_WALL * width }
    }

    fn kind(&self, side: Segment) -> Option<Kind> {
        let nearest = self.index.nearest_within(side.point_at(0.5), self.near)?;
        self.kinds.get(nearest.index).copied()
    }
}

/// For each vertex the share of pairs in which the outer piece comes first if the cycle begins there; `None` where one of both is missing.
fn shares(curve: &ClosedCurve, kinds: &[Option<Kind>]) -> Option<Vec<f64>> {
    let length_of = |kind: Kind| -> f64 {
        curve
            .segments()
            .zip(kinds)
            .filter(|(_, own)| **own == Some(kind))
            .map(|(side, _)| side.length())
            .sum()
    };
    let (outer, other) = (length_of(Kind::Outer), length_of(Kind::Other));
    if !(outer > 0.0 && other > 0.0) {
        return None;
    }
    let (mut laid, mut first) = (0.0, 0.0);
    for (side, kind) in curve.segments().zip(kinds) {
        match kind {
            Some(Kind::Outer) => laid += side.length(),
            Some(Kind::Other) => first += side.length() * laid,
            None => {}
        }
    }
    let mut share = first / (outer * other);
    let at_vertex = |(side, kind): (Segment, &Option<Kind>)| {
        let here = share;
        match kind {
            Some(Kind::Outer) => share -= side.length() / outer,
            Some(Kind::Other) => share += side.length() / other,
            None => {}
        }
        here.clamp(0.0, 1.0)
    };
    Some(curve.segments().zip(kinds).map(at_vertex).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_follow_the_start_along_the_cycle() {
        let square = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)].map(DVec2::from).to_vec();
        let square = ClosedCurve::new(square).expect("a square is a curve");
        let (outer, other) = (Some(Kind::Outer), Some(Kind::Other));
        // Two sides of outer wall, then two of another.
        assert_eq!(shares(&square, &[outer, outer, other, other]), Some(vec![1.0, 0.5, 0.0, 0.5]));
        assert_eq!(shares(&square, &[outer, None, other, None]), Some(vec![1.0, 0.0, 0.0, 1.0]));
        assert_eq!(shares(&square, &[outer, outer, None, None]), None);
    }
}
