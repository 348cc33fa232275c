//! What must be true of every layer, by brute force.

use argil_slice::{Layer, Loss, SliceSettings, WallLoop, outer_walls};
use geo::{Area, Contains, Distance, Euclidean};
use geo_types::{Coord, LineString, Point, Polygon};
use glam::DVec2;
use proptest::prelude::*;

pub(crate) fn settings(walls: usize) -> SliceSettings {
    SliceSettings { walls, ..SliceSettings::default() }
}

pub(crate) fn area(layer: &Layer) -> f64 {
    layer.outline.unsigned_area()
}

pub(crate) fn polygon(points: &[DVec2]) -> Polygon<f64> {
    Polygon::new(LineString(points.iter().map(|p| Coord { x: p.x, y: p.y }).collect()), vec![])
}

pub(crate) fn segments(wall: &WallLoop) -> Vec<(DVec2, DVec2)> {
    (0..wall.points.len()).map(|k| (wall.points[k], wall.points[(k + 1) % wall.points.len()])).collect()
}

pub(crate) fn distance_to(p: DVec2, (a, b): (DVec2, DVec2)) -> f64 {
    let t = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
    p.distance(a + (b - a) * t)
}

fn separation(s: (DVec2, DVec2), t: (DVec2, DVec2)) -> f64 {
    let turn = |a: DVec2, b: DVec2, c: DVec2| (b - a).perp_dot(c - a).signum();
    if turn(s.0, s.1, t.0) * turn(s.0, s.1, t.1) < 0.0 && turn(t.0, t.1, s.0) * turn(t.0, t.1, s.1) < 0.0 {
        return 0.0;
    }
    [distance_to(s.0, t), distance_to(s.1, t), distance_to(t.0, s), distance_to(t.1, s)]
        .into_iter()
        .fold(f64::MAX, f64::min)
}

/// Everything that the later stages rely on, by brute force.
pub(crate) fn check(layer: &Layer, settings: &SliceSettings) -> Result<(), TestCaseError> {
    let (walls, grid) = (&layer.walls, settings.grid);
    for (index, wall) in walls.iter().enumerate() {
        let on_grid = |v: f64| (v * 1e4).round() / 1e4 == v;
        prop_assert!(wall.points.iter().all(|p| on_grid(p.x) && on_grid(p.y)), "off the grid");
        let sides = segments(wall);
        let n = sides.len();
        prop_assert!(n >= 3);
        for a in 0..n {
            for b in a + 2..n {
                if (b + 1) % n != a {
                    prop_assert!(separation(sides[a], sides[b]) > 3.0 * grid, "loop {index} meets itself");
                }
            }
            prop_assert!(distance_to(sides[(a + 1) % n].1, sides[a]) > 3.0 * grid, "loop {index} turns back");
        }
        for other in &walls[..index] {
            for &s in &sides {
                prop_assert!(segments(other).iter().all(|&t| separation(s, t) > 20.0 * grid), "loops meet");
            }
        }
        // About a point of the loop: far from the origin the products would swallow the area.
        let near = wall.points[0];
        let signed: f64 = sides.iter().map(|(a, b)| (*a - near).perp_dot(*b - near)).sum();
        prop_assert_eq!(signed < 0.0, wall.hole);
        let around: Vec<usize> = (0..walls.len())
            .filter(|&k| {
                k != index
                    && polygon(&walls[k].points).contains(&Point::new(wall.points[0].x, wall.points[0].y))
            })
            .collect();
        prop_assert_eq!(wall.depth, around.len());
        match wall.parent {
            None => prop_assert!(around.is_empty()),
            Some(parent) => prop_assert!(around.contains(&parent) && walls[parent].depth + 1 == wall.depth),
        }
        if settings.walls == 1 {
            prop_assert_eq!(wall.hole, wall.depth % 2 == 1);
        }
        // A bead's middle lies as far inside the outline as its wall says.
        let reach = (wall.wall as f64 + 0.5) * settings.width;
        for p in &wall.points {
            let at = Point::new(p.x, p.y);
            prop_assert!(
                layer.outline.contains(&at),
                "{p} outside its outline: {wall:?} {:?}",
                layer.outline
            );
            let rings = layer.outline.iter().flat_map(|p| std::iter::once(p.exterior()).chain(p.interiors()));
            let depth = rings.map(|ring| Euclidean.distance(&at, ring)).fold(f64::MAX, f64::min);
            if !wall.thin {
                // The first wall has tips in its corners; a further one that meets itself lies 0.024 w farther out, and is
                // opened and simplified like all others.
                let slack = if wall.wall == 0 { 0.07 } else { 0.04 } * settings.width;
                prop_assert!((depth - reach).abs() < slack, "wall {} at {depth}", wall.wall);
            }
        }
    }
    for outline in &layer.outline {
        let inside = |p: DVec2| outline.contains(&Point::new(p.x, p.y));
        let printed = walls.iter().any(|wall| inside(wall.points[0]));
        prop_assert!(
            printed || layer.losses.iter().any(|loss| inside(loss.at())),
            "an outline without a word"
        );
    }
    prop_assert!(layer.losses.iter().all(|loss| loss.layer() == layer.index));
    prop_assert_eq!(outer_walls(layer).0.len(), walls.iter().filter(|wall| wall.depth == 0).count());
    Ok(())
}

/// Every point of the outline lies within a bead of a wall or near a place that is reported as bare.
pub(crate) fn check_cover(layer: &Layer, width: f64) -> Result<(), TestCaseError> {
    let sides: Vec<_> = layer.walls.iter().flat_map(segments).collect();
    let reported: Vec<DVec2> = layer
        .losses
        .iter()
        .filter(|loss| matches!(loss, Loss::Branch { .. } | Loss::Vanished { .. } | Loss::Unsound { .. }))
        .map(Loss::at)
        .collect();
    let rings = layer.outline.iter().flat_map(|p| std::iter::once(p.exterior()).chain(p.interiors()));
    for line in rings.flat_map(|ring| ring.lines()) {
        let (a, b) = (DVec2::new(line.start.x, line.start.y), DVec2::new(line.end.x, line.end.y));
        let parts = (a.distance(b) / 0.1).ceil().max(1.0) as usize;
        for p in (0..=parts).map(|k| a.lerp(b, k as f64 / parts as f64)) {
            let distance = sides.iter().map(|&side| distance_to(p, side)).fold(f64::MAX, f64::min);
            let is_reported = reported.iter().any(|at| at.distance(p) < 2.0 * width);
            prop_assert!(distance < 0.75 * width || is_reported, "{p} is bare by {distance}");
        }
    }
    Ok(())
}
