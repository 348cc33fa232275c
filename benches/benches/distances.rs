//! Shortest path lengths between all support points of a layer, and building the graph they are measured in.

use std::hint::black_box;

use argil_benches::{MixedLayer, by_heap, by_petgraph, petgraph_of};
use criterion::{BatchSize, BenchmarkId, Criterion, criterion_group, criterion_main};

fn distances(c: &mut Criterion) {
    let mut group = c.benchmark_group("distances");
    group.sample_size(10);
    for size in [50, 100, 200, 400, 800, 1600] {
        let layer = MixedLayer::new(size, 1);
        let graph = layer.graph().expect("a mixed layer has a graph");
        let among: Vec<u32> = (0..size).map(|k| graph.terminal(k)).collect();
        group.bench_with_input(BenchmarkId::new("build", size), &layer, |b, layer| {
            b.iter(|| black_box(layer).graph());
        });
        // A graph keeps what its first search finds out, so that every round gets one that knows nothing yet.
        group.bench_with_input(BenchmarkId::new("argil", size), &graph, |b, graph| {
            b.iter_batched(|| graph.clone(), |graph| graph.distances(&among), BatchSize::LargeInput);
        });
        if size <= 400 {
            let other = petgraph_of(&graph);
            group.bench_with_input(BenchmarkId::new("petgraph", size), &other, |b, other| {
                b.iter(|| by_petgraph(other, &among));
            });
            group.bench_with_input(BenchmarkId::new("heap", size), &graph, |b, graph| {
                b.iter(|| by_heap(graph, &among));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, distances);
criterion_main!(benches);
