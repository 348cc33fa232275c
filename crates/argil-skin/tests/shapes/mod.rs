//! Outlines drawn by lot, their walls, and what crosses what.

use std::f64::consts::TAU;

use argil_curve::{DVec2, Segment, SegmentIndex, self_crossings};
use argil_skin::ModelLoop;
use geo::buffer::{BufferStyle, LineJoin};
use geo::{BooleanOps, Buffer};
use geo_types::{Coord, LineString, MultiPolygon, Polygon};
use proptest::prelude::*;

pub(crate) const WIDTH: f64 = 1.5;
pub(crate) const GRID: f64 = 1e-4;

pub(crate) fn disc(radius: f64, at: (f64, f64)) -> MultiPolygon<f64> {
    let corner = |k: u32| {
        let angle = TAU * f64::from(k) / 72.0;
        Coord { x: at.0 + radius * angle.cos(), y: at.1 + radius * angle.sin() }
    };
    MultiPolygon(vec![Polygon::new(LineString((0..72).map(corner).collect()), Vec::new())])
}

pub(crate) fn inset(region: &MultiPolygon<f64>, distance: f64) -> MultiPolygon<f64> {
    region.buffer_with_style(BufferStyle::new(-distance).line_join(LineJoin::Round(0.1)))
}

/// The first walls of an outline, as a slicer would lay them: opened a little, on the grid.
pub(crate) fn walls(outline: &MultiPolygon<f64>) -> Vec<Vec<DVec2>> {
    let region = inset(&inset(outline, 0.53 * WIDTH), -0.03 * WIDTH);
    let rings = region.iter().flat_map(|p| std::iter::once(p.exterior()).chain(p.interiors()));
    rings
        .map(|ring| {
            let mut points: Vec<DVec2> = Vec::new();
            for c in &ring.0[1..] {
                let point = (DVec2::new(c.x, c.y) / GRID).round() * GRID;
                if points.last().is_none_or(|last| last.distance(point) > 0.02) {
                    points.push(point);
                }
            }
            points
        })
        .filter(|ring| ring.len() > 3)
        .collect()
}

/// Outlines of a few layers: discs that come and go, with holes.
pub(crate) fn stack() -> impl Strategy<Value = Vec<MultiPolygon<f64>>> {
    let blob = (3.0..14.0, -8.0..8.0, -8.0..8.0).prop_map(|(r, x, y)| disc(r, (x, y)));
    let layer = (prop::collection::vec(blob.clone(), 1..4), prop::collection::vec(blob, 0..2)).prop_map(
        |(solid, holes)| {
            let all = solid.into_iter().reduce(|a, b| a.union(&b)).unwrap_or(MultiPolygon(Vec::new()));
            holes.iter().fold(all, |rest, hole| rest.difference(&inset(hole, 1.0)))
        },
    );
    prop::collection::vec(layer, 1..6)
}

pub(crate) fn sides(one: &ModelLoop) -> impl Iterator<Item = Segment> + '_ {
    let n = one.points.len();
    (0..n).map(move |k| Segment::new(one.points[k], one.points[(k + 1) % n]))
}

/// Whether no loop crosses itself or another.
pub(crate) fn is_plane(loops: &[ModelLoop]) -> bool {
    let mut earlier = Vec::new();
    for one in loops {
        let index = SegmentIndex::new(std::mem::take(&mut earlier), WIDTH);
        let mut crosses = !self_crossings(&one.points).is_empty();
        for side in sides(one) {
            index.for_each_near(side, 0.0, |_, other| crosses |= side.crosses(&other));
        }
        if crosses {
            return false;
        }
        earlier = index.segments().iter().copied().chain(sides(one)).collect();
    }
    true
}
