//! Shortest path lengths between all support points of a layer, and building the graph they are measured in.

use std::hint::black_box;

use argil_benches::MixedLayer;
use argil_graph::PathGraph;
use criterion::{BatchSize, BenchmarkId, Criterion, criterion_group, criterion_main};
use petgraph::graph::{NodeIndex, UnGraph};

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
            let other = without_attachments(&graph);
            group.bench_with_input(BenchmarkId::new("petgraph", size), &other, |b, other| {
                b.iter(|| {
                    let from =
                        |v: &u32| petgraph::algo::dijkstra(other, (*v).into(), None, |edge| *edge.weight());
                    among.iter().map(from).map(|reached| reached.len()).sum::<usize>()
                });
            });
        }
    }
    group.finish();
}

/// The same graph for petgraph. Paths never pass attachments, and none begins there.
fn without_attachments(graph: &PathGraph) -> UnGraph<(), f64> {
    let mut other = UnGraph::with_capacity(graph.vertex_count(), graph.edge_count());
    for _ in 0..graph.vertex_count() {
        other.add_node(());
    }
    for (a, b, weight) in
        graph.edges().filter(|edge| !graph.is_attachment(edge.0) && !graph.is_attachment(edge.1))
    {
        other.add_edge(NodeIndex::from(a), NodeIndex::from(b), weight);
    }
    other
}

criterion_group!(benches, distances);
criterion_main!(benches);
