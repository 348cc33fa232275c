use argil_curve::{ClosedCurve, DVec2, Segment, SegmentIndex, self_crossings};
use argil_route::{Cycle, Demand, LayerInput, Leg, RouteSettings, Router, Wall};

use crate::Draw;

/// The output grid, mm.
const GRID: f64 = 1e-4;

/// A layer of walls and demands becomes one cycle that crosses nothing, has every wall and passes every demand.
pub fn route(bytes: &[u8]) {
    let mut draw = Draw::new(bytes);
    let scene = Scene::drawn(&mut draw);
    let walls: Vec<Wall<'_>> =
        scene.rings.iter().map(|(points, parent)| Wall { points, parent: *parent }).collect();
    let input = LayerInput { walls: &walls, demands: &scene.demands, safeguard: &[], above: None, barred: &[] };
    let settings = RouteSettings::default();
    let router = Router::new(settings.clone()).expect("the settings are argil's own");
    match router.cycle(&input) {
        Ok(cycle) => is_sound(&scene, &cycle, &settings),
        Err(argil_route::RouteError::Empty) => assert!(walls.is_empty() && scene.demands.is_empty()),
        Err(error) => panic!("{error}"),
    }
}

#[derive(Debug, Default)]
struct Scene {
    rings: Vec<(Vec<DVec2>, Option<usize>)>,
    curves: Vec<ClosedCurve>,
    demands: Vec<Demand>,
}

impl Scene {
    /// Bodies in the cells of a lattice, some hollow, some with an island in the hollow, and demands clear of them.
    fn drawn(draw: &mut Draw<'_>) -> Self {
        let mut scene = Self::default();
        for cell in 0..6 {
            let kind = draw.below(5);
            let centre = DVec2::new(18.0 * (cell % 3) as f64, 18.0 * (cell / 3) as f64);
            let radius = draw.within(1.0, 7.0);
            let first = scene.rings.len();
            for nested in 0..kind.min(3) {
                let factor = [1.0, 0.6, 0.2][nested];
                if radius * factor < 0.8 {
                    break;
                }
                let parent = nested.checked_sub(1).map(|outside| first + outside);
                let ring = ring(draw, centre, radius * factor, nested == 1);
                scene.curves.push(ClosedCurve::new(ring.clone()).expect("a ring is a curve"));
                scene.rings.push((ring, parent));
            }
        }
        let index = SegmentIndex::of_curves(&scene.curves, 1.5);
        while scene.demands.len() < 30 && !draw.is_empty() {
            let position = DVec2::new(draw.within(-12.0, 52.0), draw.within(-12.0, 32.0));
            if index.distance(position) > 0.3 {
                scene.demands.push(Demand { position, anchors: vec![position] });
            }
        }
        scene
    }
}

/// A ring that waves by up to a seventh of its radius.
fn ring(draw: &mut Draw<'_>, centre: DVec2, radius: f64, hole: bool) -> Vec<DVec2> {
    let (corners, waves, height) = (6 + draw.below(40), draw.below(8) as f64, draw.within(0.0, 0.15));
    let at = |k: usize| {
        let angle = k as f64 * std::f64::consts::TAU / corners as f64;
        let p = centre + radius * (1.0 + height * (waves * angle).sin()) * DVec2::from_angle(angle);
        (p / GRID).round() * GRID
    };
    let mut points: Vec<DVec2> = (0..corners).map(at).collect();
    if hole {
        points.reverse();
    }
    points
}

fn is_sound(scene: &Scene, cycle: &Cycle, settings: &RouteSettings) {
    let n = cycle.points.len();
    assert_eq!((cycle.fixed.len(), cycle.legs.len()), (n, n));
    let crossings = self_crossings(&cycle.points);
    assert!(crossings.is_empty(), "{crossings:?}");
    let walls: f64 = scene.curves.iter().map(ClosedCurve::length).sum();
    let laid = cycle.length_of(Leg::Wall);
    assert!((laid - walls).abs() < 1e-3 * (1.0 + scene.rings.len() as f64), "{laid} of {walls} mm of wall");
    for vertex in scene.rings.iter().flat_map(|ring| &ring.0) {
        assert!(
            (0..n).any(|k| cycle.points[k] == *vertex && cycle.fixed[k]),
            "wall vertex {vertex} is missing"
        );
    }
    for (index, demand) in scene.demands.iter().enumerate() {
        let carrier =
            cycle.carriers.iter().find(|carrier| carrier.1 == index).expect("every demand is carried");
        let off = cycle.points[carrier.0].distance(demand.anchors[0]);
        assert!(off <= settings.slack + 2.0 * GRID, "demand {index} is passed at {off} mm");
    }
    for k in (0..n).filter(|&k| cycle.legs[k] != Leg::Wall) {
        let stretch = Segment::new(cycle.points[k], cycle.points[(k + 1) % n]);
        for wall in scene.curves.iter().flat_map(ClosedCurve::segments) {
            let ends = [stretch.start, stretch.end].iter().any(|&p| wall.distance(p) < 10.0 * GRID);
            assert!(ends || !wall.crosses(&stretch), "{stretch:?} passes {wall:?}");
        }
    }
}
