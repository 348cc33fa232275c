//! What holds for every tour.

use argil_tour::{MatrixMetric, Metric, TourOptions, shortest_tour};
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

fn points(count: std::ops::Range<usize>) -> impl Strategy<Value = Vec<(f64, f64)>> {
    prop::collection::vec((-50.0..50.0_f64, -50.0..50.0_f64), count)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn every_node_once_and_never_longer_than_the_start(points in points(0..60)) {
        let n = points.len();
        let distances = plane(&points);
        let metric = MatrixMetric::new(n, &distances).unwrap();
        let start: Vec<usize> = (0..n).collect();
        let tour = shortest_tour(&metric, &[], Some(&start), &TourOptions::default());
        prop_assert!(is_permutation(&tour.order, n));
        prop_assert!(tour.length <= length(&metric, &start) * (1.0 + 1e-12));
        prop_assert!((tour.length - length(&metric, &tour.order)).abs() <= 1e-9);
    }
}
