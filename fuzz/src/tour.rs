use argil_tour::{MatrixMetric, Metric, TourOptions, shortest_tour};

use crate::Draw;

/// Tours over any symmetric matrix are permutations, as long as they say, never longer than their start and, where
/// the shortest is known, never shorter than that.
pub fn tour(bytes: &[u8]) {
    let mut draw = Draw::new(bytes);
    let nodes = draw.below(32);
    let fine = draw.flag();
    let options = TourOptions {
        exact_up_to: 0,
        neighbours: 1 + draw.below(8),
        kicks_per_node: draw.within(0.0, 12.0),
        patience_per_node: draw.within(0.0, 12.0),
        seed: u64::from(draw.byte()),
    };
    let mut entries = vec![0.0; nodes * nodes];
    for a in 0..nodes {
        for b in 0..a {
            let value = if fine { draw.within(0.0, 10.0) } else { f64::from(draw.byte() % 8) };
            entries[a * nodes + b] = value;
            entries[b * nodes + a] = value;
        }
    }
    let metric = MatrixMetric::new(nodes, &entries).expect("a symmetric matrix of lengths is a metric");
    let shuffled = draw.flag();
    let mut start: Vec<usize> = (0..nodes).collect();
    for k in (1..nodes).rev().filter(|_| shuffled) {
        start.swap(k, draw.below(k + 1));
    }
    let candidates: Vec<Vec<u32>> = (0..draw.below(nodes + 2))
        .map(|_| (0..draw.below(4)).map(|_| u32::from(draw.byte() % 40)).collect())
        .collect();

    let better = shortest_tour(&metric, &candidates, Some(&start), &options);
    is_tour(&metric, &better.order, better.length);
    let limit = length(&metric, &start);
    assert!(better.length <= limit * (1.0 + 1e-12), "{} is longer than the start, {limit}", better.length);

    let cold = shortest_tour(&metric, &candidates, None, &options);
    is_tour(&metric, &cold.order, cold.length);
    // Another start, which may leave out nodes and name some twice, is mended.
    let broken: Vec<usize> = (0..draw.below(40)).map(|_| draw.below(40)).collect();
    let mended = shortest_tour(&metric, &candidates, Some(&broken), &options);
    is_tour(&metric, &mended.order, mended.length);
    if nodes <= 9 {
        let exact = shortest_tour(&metric, &[], None, &TourOptions { exact_up_to: 9, ..options });
        is_tour(&metric, &exact.order, exact.length);
        for tour in [&better, &cold, &mended] {
            assert!(
                exact.length <= tour.length + 1e-9,
                "{} beats the shortest, {}",
                tour.length,
                exact.length
            );
        }
    }
}

fn is_tour(metric: &MatrixMetric<'_>, order: &[usize], told: f64) {
    let mut sorted = order.to_vec();
    sorted.sort_unstable();
    assert!(sorted.iter().copied().eq(0..metric.nodes()), "{order:?} is no permutation");
    let length = length(metric, order);
    assert!((length - told).abs() <= 1e-9 * (1.0 + length), "{order:?} is {length} long, not {told}");
}

fn length(metric: &MatrixMetric<'_>, order: &[usize]) -> f64 {
    (0..order.len()).map(|k| metric.distance(order[k], order[(k + 1) % order.len()])).sum()
}
