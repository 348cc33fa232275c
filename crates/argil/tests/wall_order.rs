//! What must hold where the outermost wall is wanted first, or last.

mod sample;
mod verdict;

use argil::curve::Segment;
use argil::slice::Layer;
use argil::strand::{Role, Strand};
use argil::{Plan, Planner, Settings, WallOrder};
use sample::sample;
use verdict::audited;

/// Of all pairs of a piece of outer wall and a piece of another the share in which the outer one is laid first, as the strand has it.
fn ahead(strand: &Strand, layer: usize, slice: &Layer, width: f64) -> Option<f64> {
    let points = strand.polyline(layer);
    let is_outer = |side: &Segment| {
        let middle = side.point_at(0.5);
        let near = slice.walls.iter().map(|wall| {
            let n = wall.points.len();
            let sides = (0..n).map(|k| Segment::new(wall.points[k], wall.points[(k + 1) % n]));
            (sides.map(|side| side.distance(middle)).fold(f64::INFINITY, f64::min), wall.wall == 0)
        });
        let (distance, outer) = near.min_by(|a, b| a.0.total_cmp(&b.0)).expect("there are walls");
        (distance < 0.05 * width).then_some(outer)
    };
    let (mut outer, mut other, mut pairs) = (0.0, 0.0, 0.0);
    for (pair, step) in points.windows(2).zip(strand.cycle(layer)) {
        let side = Segment::new(pair[0], pair[1]);
        match is_outer(&side).filter(|_| step.role == Role::Wall) {
            Some(true) => outer += side.length(),
            Some(false) => {
                other += side.length();
                pairs += side.length() * outer;
            }
            None => {}
        }
    }
    (outer > 0.0 && other > 0.0).then(|| pairs / (outer * other))
}

fn mean(plan: &Plan) -> f64 {
    let shares: Vec<f64> = plan.layers.iter().filter_map(|layer| layer.outer_ahead).collect();
    assert!(!shares.is_empty(), "no layer has other walls");
    shares.iter().sum::<f64>() / shares.len() as f64
}

#[test]
fn walls_come_in_their_order_and_the_strand_stays_sound() {
    for (name, width) in [("columns", 2.0), ("table", 3.0)] {
        let mesh = sample(name);
        let with = |wall_order| Settings { walls: 2, wall_order, ..Settings::for_width(width) };
        let slices = Planner::default().slices(&mesh, &with(WallOrder::Any)).expect("it can be cut");
        let plans = [WallOrder::Any, WallOrder::OuterFirst, WallOrder::OuterLast]
            .map(|order| Planner::default().plan(&mesh, &with(order)).expect("it can be planned"));
        assert!(plans[0].layers.iter().all(|layer| layer.outer_ahead.is_none()), "nothing was asked for");
        for plan in &plans[1..] {
            assert!(audited(plan, &mesh, &with(WallOrder::Any)).is_sound(), "{name}");
            for (k, (layer, slice)) in plan.layers.iter().zip(&slices).enumerate() {
                let found = ahead(&plan.strand, k, slice, width);
                assert_eq!(found.is_some(), layer.outer_ahead.is_some(), "{name}, layer {k}");
                let (found, told) = (found.unwrap_or_default(), layer.outer_ahead.unwrap_or_default());
                assert!((found - told).abs() < 0.02, "{name}, layer {k}: {found} of {told}");
            }
        }
        let [first, last] = [mean(&plans[1]), mean(&plans[2])];
        assert!(first > 0.65 && last < 0.35, "{name}: {first}, {last}");
    }
}

#[test]
fn a_spiral_has_no_order() {
    let settings =
        Settings { walls: 2, spiral: true, wall_order: WallOrder::OuterFirst, ..Settings::default() };
    assert!(settings.check().is_err() && Settings { spiral: false, ..settings }.check().is_ok());
}
