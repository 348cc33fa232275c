//! Solvers of tours from elsewhere: any order will do, and what is no order is an error.
#![allow(clippy::unwrap_used, reason = "what fails here fails the test")]

use argil_curve::{DVec2, self_crossings};
use argil_route::{
    Cycle, Demand, LayerInput, Leg, Metric, RouteError, RouteSettings, Router, ShortestTours, TourDistances,
    TourOptions, Tours, Wall,
};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// What is made of argil's own order.
struct Altered<F>(F);

impl<F: Fn(Vec<usize>) -> Vec<usize> + Sync> Tours for Altered<F> {
    fn order(&self, distances: &TourDistances, start: Option<&[usize]>, options: &TourOptions) -> Vec<usize> {
        let order = ShortestTours.order(distances, start, options);
        assert_eq!(order.len(), distances.nodes());
        (self.0)(order)
    }
}

/// Three square bodies, one of them with a hole, and points round about.
fn routed(points: &[(f64, f64)], tours: &dyn Tours) -> Result<Cycle, RouteError> {
    let square = |x: f64, y: f64, side: f64| {
        [(x, y), (x + side, y), (x + side, y + side), (x, y + side)].map(DVec2::from).to_vec()
    };
    let mut hole = square(33.0, 3.0, 8.0);
    hole.reverse();
    let loops = [square(0.0, 0.0, 10.0), square(30.0, 0.0, 14.0), hole, square(10.0, 26.0, 9.0)];
    let parents = [None, None, Some(1), None];
    let walls: Vec<Wall<'_>> =
        loops.iter().zip(parents).map(|(points, parent)| Wall { points, parent }).collect();
    let demands: Vec<Demand> =
        points.iter().map(|&p| Demand { position: p.into(), anchors: vec![p.into()] }).collect();
    let layer = LayerInput { walls: &walls, demands: &demands, safeguard: &[], above: None, barred: &[] };
    Router::new(RouteSettings::default()).unwrap().cycle_with(&layer, tours)
}

const POINTS: [(f64, f64); 6] =
    [(16.0, 4.0), (22.0, 12.0), (37.0, 7.0), (25.0, 30.0), (4.0, 18.0), (37.0, 22.0)];

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, rng_seed: RngSeed::Fixed(1), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_order_gives_a_sound_cycle(keys in prop::collection::vec(any::<u16>(), 24)) {
        let shuffled = |mut order: Vec<usize>| {
            order.sort_by_key(|&stop| (keys[stop % keys.len()], stop));
            order
        };
        let cycle = routed(&POINTS, &Altered(shuffled)).unwrap();
        prop_assert!(self_crossings(&cycle.points).is_empty());
        prop_assert!((cycle.length_of(Leg::Wall) - 40.0 - 56.0 - 32.0 - 36.0).abs() < 0.1);
        for demand in 0..POINTS.len() {
            prop_assert!(cycle.carriers.iter().any(|carrier| carrier.1 == demand));
        }
    }
}

#[test]
fn the_own_solver_is_the_default() {
    assert_eq!(routed(&POINTS, &Altered(|order| order)), routed(&POINTS, &ShortestTours));
}

type Spoil = fn(Vec<usize>) -> Vec<usize>;

#[test]
fn what_is_no_order_of_all_stops_is_an_error() {
    let spoilt: [Spoil; 4] = [
        |_| Vec::new(),
        |mut order| {
            order.pop();
            order
        },
        |order| order.iter().map(|_| 0).collect(),
        |order| order.iter().map(|stop| stop + 1).collect(),
    ];
    for spoil in spoilt {
        let outcome = routed(&POINTS, &Altered(spoil));
        assert!(matches!(outcome, Err(RouteError::Tour { stops: 2.., .. })), "{outcome:?}");
    }
}
