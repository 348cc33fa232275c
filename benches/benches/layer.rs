//! One layer routed: walls and support points into one cycle.

use std::hint::black_box;

use argil_benches::{MixedLayer, WIDTH};
use argil_route::{Demand, LayerInput, RouteSettings, Router, Wall};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

fn layer(c: &mut Criterion) {
    let mut group = c.benchmark_group("layer");
    group.sample_size(10);
    let router = Router::new(RouteSettings::for_width(WIDTH)).expect("the settings are argil's own");
    for size in [50, 100, 200, 400] {
        let mixed = MixedLayer::new(size, 1);
        let walls: Vec<Wall<'_>> =
            mixed.obstacles.iter().map(|points| Wall { points, parent: None }).collect();
        let demands: Vec<Demand> =
            mixed.terminals.iter().map(|&position| Demand { position, anchors: vec![position] }).collect();
        let input = LayerInput { walls: &walls, demands: &demands, safeguard: &[], above: None, barred: &[] };
        group.throughput(Throughput::Elements(size as u64));
        group.bench_with_input(BenchmarkId::new("route", size), &input, |b, input| {
            b.iter(|| router.cycle(black_box(input)).expect("a mixed layer can be routed"));
        });
    }
    group.finish();
}

criterion_group!(benches, layer);
criterion_main!(benches);
