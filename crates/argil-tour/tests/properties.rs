//! What holds for every tour.

use argil_tour::{MatrixMetric, Metric, TourOptions, TourSolver, shortest_tour};
use proptest::prelude::*;

fn plane(points: &[(f64, f64)]) -> Vec<f64> {
    let mut distances = Vec::new();
    for a in points {
        for b in points {
            distances.push((a.0 - b.0).hypot(a.1 - b.1));
        }
    }
    distances
}

fn length<M: Metric>(metric: &M, order: &[usize]) -> f64 {
    (0..order.len()).map(|k| metric.distance(order[k], order[(k + 1) % order.len()])).sum()
}

fn is_permutation(order: &[usize], n: usize) -> bool {
    let mut sorted = order.to_vec();
    sorted.sort_unstable();
    sorted == (0..n).collect::<Vec<_>>()
}

/// The length of the shortest tour, by trying all orders of the nodes from `fixed` on.
fn shortest_of_all<M: Metric>(metric: &M, order: &mut Vec<usize>, fixed: usize) -> f64 {
    if fixed == order.len() {
        return length(metric, order);
    }
    let mut least = f64::INFINITY;
    for k in fixed..order.len() {
        order.swap(fixed, k);
        least = least.min(shortest_of_all(metric, order, fixed + 1));
        order.swap(fixed, k);
    }
    least
}

/// Points on a coarse grid as often as anywhere: equal points and equal distances are what breaks ties.
fn points(count: std::ops::Range<usize>) -> impl Strategy<Value = Vec<(f64, f64)>> {
    let anywhere = prop::collection::vec((-50.0..50.0_f64, -50.0..50.0_f64), count.clone());
    let on_a_grid = prop::collection::vec((0..8_i32, 0..8_i32), count)
        .prop_map(|points| points.into_iter().map(|(x, y)| (f64::from(x), f64::from(y))).collect());
    prop_oneof![anywhere, on_a_grid]
}

fn search_only(kicks_per_node: f64) -> TourOptions {
    TourOptions { exact_up_to: 0, kicks_per_node, ..TourOptions::default() }
}

fn cases(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() }
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn a_tour_visits_every_node_once_and_is_never_longer_than_its_start(
        points in points(0..60),
        kicks in 0..4_u32,
        seed in any::<u64>(),
    ) {
        let n = points.len();
        let distances = plane(&points);
        let metric = MatrixMetric::new(n, &distances).unwrap();
        let start: Vec<usize> = (0..n).collect();
        let options = TourOptions { seed, ..search_only(f64::from(kicks) / 2.0) };
        let tour = shortest_tour(&metric, &[], Some(&start), &options);
        prop_assert!(is_permutation(&tour.order, n));
        prop_assert!(tour.length <= length(&metric, &start) * (1.0 + 1e-12));
        prop_assert!((tour.length - length(&metric, &tour.order)).abs() <= 1e-9);
    }

    #[test]
    fn a_tour_has_one_canonical_form(points in points(3..40)) {
        let distances = plane(&points);
        let metric = MatrixMetric::new(points.len(), &distances).unwrap();
        let tour = shortest_tour(&metric, &[], None, &TourOptions::default());
        prop_assert_eq!(tour.order[0], 0);
        prop_assert!(tour.order[1] < tour.order[points.len() - 1]);
    }

    #[test]
    fn few_nodes_are_toured_as_short_as_can_be(points in points(1..8)) {
        let n = points.len();
        let distances = plane(&points);
        let metric = MatrixMetric::new(n, &distances).unwrap();
        let least = shortest_of_all(&metric, &mut (0..n).collect(), 1);
        let tour = shortest_tour(&metric, &[], None, &TourOptions::default());
        prop_assert!(is_permutation(&tour.order, n));
        prop_assert!((tour.length - least).abs() <= 1e-9);
    }

    #[test]
    fn a_search_is_never_shorter_than_the_exact_tour(points in points(4..12), seed in any::<u64>()) {
        let distances = plane(&points);
        let metric = MatrixMetric::new(points.len(), &distances).unwrap();
        let exact = shortest_tour(&metric, &[], None, &TourOptions::default());
        let searched = shortest_tour(&metric, &[], None, &TourOptions { seed, ..search_only(0.2) });
        prop_assert!(searched.length >= exact.length - 1e-9);
    }

    #[test]
    fn more_kicks_never_make_a_tour_longer(points in points(8..80), few in 0..3_u32, seed in any::<u64>()) {
        let distances = plane(&points);
        let metric = MatrixMetric::new(points.len(), &distances).unwrap();
        let with = |kicks: u32| {
            let options = TourOptions { seed, ..search_only(f64::from(kicks) / 4.0) };
            shortest_tour(&metric, &[], None, &options).length
        };
        prop_assert!(with(few + 2) <= with(few) + 1e-9);
    }

    #[test]
    fn any_start_is_mended(points in points(0..30), start in prop::collection::vec(0..40_usize, 0..40)) {
        let distances = plane(&points);
        let metric = MatrixMetric::new(points.len(), &distances).unwrap();
        let tour = shortest_tour(&metric, &[], Some(&start), &search_only(0.1));
        prop_assert!(is_permutation(&tour.order, points.len()));
    }

    #[test]
    fn any_candidates_will_do(
        points in points(4..30),
        candidates in prop::collection::vec(prop::collection::vec(0..40_u32, 0..10), 0..40),
    ) {
        let distances = plane(&points);
        let metric = MatrixMetric::new(points.len(), &distances).unwrap();
        let options = TourOptions { neighbours: 0, ..search_only(0.1) };
        let tour = shortest_tour(&metric, &candidates, None, &options);
        prop_assert!(is_permutation(&tour.order, points.len()));
    }

    #[test]
    fn what_is_no_metric_still_gives_a_permutation(
        n in 0..30_usize,
        entries in prop::collection::vec(
            prop_oneof![any::<f64>(), Just(f64::INFINITY), Just(f64::NAN), Just(f64::NEG_INFINITY), 0.0..1.0_f64],
            900,
        ),
        exact in any::<bool>(),
    ) {
        struct Anything(usize, Vec<f64>);
        impl Metric for Anything {
            fn nodes(&self) -> usize {
                self.0
            }
            fn distance(&self, a: usize, b: usize) -> f64 {
                self.1[a * 30 + b]
            }
        }
        let options = if exact { TourOptions { exact_up_to: 9, ..search_only(0.2) } } else { search_only(0.2) };
        let tour = shortest_tour(&Anything(n, entries), &[], None, &options);
        prop_assert!(is_permutation(&tour.order, n));
    }
}

proptest! {
    #![proptest_config(cases(12))]

    #[test]
    fn a_tour_that_begins_with_paths_visits_every_node_once(points in points(100..220), seed in any::<u64>()) {
        let distances = plane(&points);
        let metric = MatrixMetric::new(points.len(), &distances).unwrap();
        let options = TourOptions { seed, ..search_only(0.1) };
        let mut solver = TourSolver::new();
        let tour = solver.solve(&metric, &[], None, &options);
        prop_assert!(is_permutation(&tour.order, points.len()));
        prop_assert_eq!(&solver.solve(&metric, &[], None, &options), &tour, "a solver remembers nothing");
        prop_assert_eq!(&shortest_tour(&metric, &[], None, &options), &tour);
    }
}

proptest! {
    #![proptest_config(cases(40))]

    #[test]
    fn rows_in_memory_change_no_tour(points in points(15..150), neighbours in 1..9_usize) {
        /// The same distances, one at a time.
        struct OneByOne<'a>(MatrixMetric<'a>);
        impl Metric for OneByOne<'_> {
            fn nodes(&self) -> usize {
                self.0.nodes()
            }
            fn distance(&self, a: usize, b: usize) -> f64 {
                self.0.distance(a, b)
            }
        }
        let distances = plane(&points);
        let metric = MatrixMetric::new(points.len(), &distances).unwrap();
        let options = TourOptions { neighbours, ..search_only(0.3) };
        let tour = shortest_tour(&metric, &[], None, &options);
        prop_assert_eq!(shortest_tour(&OneByOne(metric), &[], None, &options), tour);
    }
}
