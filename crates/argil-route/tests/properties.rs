//! What holds of every cycle, whatever the walls and demands.
#![allow(clippy::unwrap_used, reason = "what cannot be set up fails the test")]

use argil_curve::{ClosedCurve, DVec2, self_crossings};
use argil_route::{Cycle, Demand, LayerInput, Leg, RouteSettings, Router, Wall};
use proptest::prelude::*;

const GRID: f64 = 1e-4;

fn on_grid(p: DVec2) -> DVec2 {
    (p / GRID).round() * GRID
}

/// A wavy ring: counter-clockwise, or clockwise for a hole.
fn ring(centre: DVec2, radius: f64, waves: f64, hole: bool) -> Vec<DVec2> {
    let mut points: Vec<DVec2> = (0..40)
        .map(|k| {
            let angle = f64::from(k) * std::f64::consts::TAU / 40.0;
            let r = radius * (1.0 + 0.15 * (waves * angle).sin());
            on_grid(centre + r * DVec2::from_angle(angle))
        })
        .collect();
    if hole {
        points.reverse();
    }
    points
}

/// A layer: bodies on a lattice, some hollow, some with an island in the hollow.
#[derive(Clone, Debug)]
struct Scene {
    rings: Vec<(Vec<DVec2>, Option<usize>)>,
    demands: Vec<Demand>,
}

fn scene() -> impl Strategy<Value = Scene> {
    let body = (1.5..6.0_f64, 0..6_u8, 0..3_u8);
    let bodies = prop::collection::vec(prop::option::weighted(0.6, body), 6);
    let demands = prop::collection::vec((-12.0..52.0_f64, -12.0..32.0_f64), 0..40);
    (bodies, demands).prop_map(|(bodies, wanted)| {
        let mut rings: Vec<(Vec<DVec2>, Option<usize>)> = Vec::new();
        for (k, body) in bodies.into_iter().enumerate() {
            let Some((radius, waves, kind)) = body else { continue };
            let centre = DVec2::new(18.0 * (k % 3) as f64, 18.0 * (k / 3) as f64);
            let outer = rings.len();
            rings.push((ring(centre, radius, f64::from(waves), false), None));
            if kind > 0 && radius > 3.0 {
                rings.push((ring(centre, 0.6 * radius, 3.0, true), Some(outer)));
                if kind > 1 && radius > 4.0 {
                    rings.push((ring(centre, 0.2 * radius, 2.0, false), Some(outer + 1)));
                }
            }
        }
        let curves: Vec<ClosedCurve> = rings.iter().map(|r| ClosedCurve::new(r.0.clone()).unwrap()).collect();
        let demands = wanted
            .into_iter()
            .map(|(x, y)| DVec2::new(x, y))
            .filter(|&p| curves.iter().all(|c| c.nearest(p).distance > 0.3))
            .map(|p| Demand { position: p, anchors: vec![p] })
            .collect();
        Scene { rings, demands }
    })
}

fn routed(scene: &Scene) -> Result<Cycle, argil_route::RouteError> {
    let walls: Vec<Wall<'_>> =
        scene.rings.iter().map(|(points, parent)| Wall { points, parent: *parent }).collect();
    let input =
        LayerInput { walls: &walls, demands: &scene.demands, safeguard: &[], above: None, barred: &[] };
    Router::new(RouteSettings::default())?.cycle(&input)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_cycle_keeps_its_invariants(scene in scene()) {
        prop_assume!(!(scene.rings.is_empty() && scene.demands.is_empty()));
        let cycle = routed(&scene).unwrap();
        let n = cycle.points.len();
        prop_assert_eq!(cycle.fixed.len(), n);
        prop_assert_eq!(cycle.legs.len(), n);

        // Nothing crosses, neither properly nor at a shared vertex.
        let crossings = self_crossings(&cycle.points);
        prop_assert!(crossings.is_empty(), "{crossings:?}");

        // Every wall is there once, its vertices bit-identical.
        let walls: f64 = scene.rings.iter().map(|r| ClosedCurve::new(r.0.clone()).unwrap().length()).sum();
        if scene.rings.len() + scene.demands.len() > 1 || !scene.rings.is_empty() {
            prop_assert!((cycle.length_of(Leg::Wall) - walls).abs() < 1e-3 * (1.0 + scene.rings.len() as f64));
        }
        for vertex in scene.rings.iter().flat_map(|r| &r.0) {
            let times = (0..n).filter(|&k| cycle.points[k] == *vertex && cycle.fixed[k]).count();
            prop_assert!(times >= 1, "wall vertex {vertex} is missing");
        }

        // Every demand is carried, within its slack.
        let slack = RouteSettings::default().slack;
        for (index, demand) in scene.demands.iter().enumerate() {
            let carrier = cycle.carriers.iter().find(|c| c.1 == index);
            prop_assert!(carrier.is_some(), "demand {index} is carried by nobody");
            let at = cycle.points[carrier.unwrap().0];
            prop_assert!(at.distance(demand.anchors[0]) <= slack + 2.0 * GRID, "{at} is too far from {demand:?}");
        }

        // No free stretch runs through a wall: its middle stays on one side.
        let curves: Vec<ClosedCurve> = scene.rings.iter().map(|r| ClosedCurve::new(r.0.clone()).unwrap()).collect();
        for k in (0..n).filter(|&k| cycle.legs[k] != Leg::Wall) {
            let stretch = argil_curve::Segment::new(cycle.points[k], cycle.points[(k + 1) % n]);
            for wall in curves.iter().flat_map(ClosedCurve::segments) {
                let ends = [stretch.start, stretch.end].iter().any(|&p| wall.distance(p) < 10.0 * GRID);
                prop_assert!(ends || !wall.crosses(&stretch), "{stretch:?} passes {wall:?}");
            }
        }
    }

    #[test]
    fn the_same_layer_gives_the_same_cycle(scene in scene()) {
        prop_assert_eq!(routed(&scene).ok(), routed(&scene).ok());
    }
}

#[test]
fn one_demand_alone_becomes_a_ring_within_its_slack() {
    let scene =
        Scene { rings: vec![], demands: vec![Demand { position: DVec2::ONE, anchors: vec![DVec2::ONE] }] };
    let cycle = routed(&scene).unwrap();
    assert!(cycle.points.len() >= 3);
    assert!(cycle.points.iter().all(|p| p.distance(DVec2::ONE) <= RouteSettings::default().slack));
}

#[test]
fn an_empty_layer_is_an_error() {
    let scene = Scene { rings: vec![], demands: vec![] };
    assert_eq!(routed(&scene), Err(argil_route::RouteError::Empty));
}

#[test]
fn a_lonely_wall_is_its_own_cycle() {
    let scene = Scene { rings: vec![(ring(DVec2::ZERO, 5.0, 3.0, false), None)], demands: vec![] };
    assert_eq!(routed(&scene).unwrap().points, scene.rings[0].0);
}

#[test]
fn where_a_line_turns_off_a_barred_place_bars_both_sides() {
    // A square with a line 0.1 mm wide that leads away from its right side.
    let square = [
        (0.0, 0.0),
        (20.0, 0.0),
        (20.0, 9.95),
        (26.0, 9.95),
        (26.0, 10.05),
        (20.0, 10.05),
        (20.0, 20.0),
        (0.0, 20.0),
    ];
    let square: Vec<DVec2> = square.into_iter().map(DVec2::from).collect();
    let walls = [Wall { points: &square, parent: None }];
    let within = DVec2::new(17.0, 10.3);
    let demands = [Demand { position: within, anchors: vec![within] }];
    let nearest_root = |barred: &[DVec2]| {
        let input = LayerInput { walls: &walls, demands: &demands, safeguard: &[], above: None, barred };
        let cycle = Router::new(RouteSettings::default()).unwrap().cycle(&input).unwrap();
        let n = cycle.points.len();
        let on_wall = |k: usize| cycle.legs[k % n] == Leg::Wall;
        let roots = (0..n).filter(|&k| on_wall(k) != on_wall(k + n - 1)).map(|k| cycle.points[k]);
        roots.map(|root| root.distance(DVec2::new(20.0, 10.0))).fold(f64::INFINITY, f64::min)
    };
    assert!(nearest_root(&[]) < 1.0, "the nearest place is beside the line");
    // Just below the line; above it is free unless both sides are barred.
    assert!(nearest_root(&[DVec2::new(19.9, 9.9)]) > 1.5);
}
