//! Tours: from nothing, and from the tour of the layer above.

use std::hint::black_box;

use argil_benches::MixedLayer;
use argil_tour::{MatrixMetric, TourOptions, TourSolver};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

fn tour(c: &mut Criterion) {
    let mut group = c.benchmark_group("tour");
    group.sample_size(10);
    let options = TourOptions::default();
    let mut solver = TourSolver::new();
    for size in [50, 100, 200, 400, 800, 1600] {
        let above = MixedLayer::new(size, 1);
        let (below, came_from) = above.below(2);
        let lengths = [&above, &below].map(|layer| layer.distances().expect("a mixed layer has a graph"));
        let [metric, next] = lengths
            .each_ref()
            .map(|entries| MatrixMetric::new(size, entries).expect("lengths are symmetric"));
        group.throughput(Throughput::Elements(size as u64));
        group.bench_with_input(BenchmarkId::new("cold", size), &metric, |b, metric| {
            b.iter(|| solver.solve(black_box(metric), &[], None, &options));
        });
        let done = solver.solve(&metric, &[], None, &options);
        let mut place = vec![0; size];
        for (k, &node) in done.order.iter().enumerate() {
            place[node] = k;
        }
        // New points have no place yet: the solver inserts what is missing.
        let mut start: Vec<usize> = (0..size).filter(|&k| came_from[k].is_some()).collect();
        start.sort_by_key(|&k| came_from[k].map(|number| place[number]));
        group.bench_with_input(BenchmarkId::new("warm", size), &next, |b, next| {
            b.iter(|| solver.solve(black_box(next), &[], Some(&start), &options));
        });
    }
    group.finish();
}

criterion_group!(benches, tour);
criterion_main!(benches);
