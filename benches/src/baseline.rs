//! What the distances of argil are measured against: one search from every terminal.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use argil_graph::PathGraph;
use petgraph::graph::{NodeIndex, UnGraph};

/// The graph for petgraph. Paths never pass attachments, and none begins there.
#[must_use]
pub fn petgraph_of(graph: &PathGraph) -> UnGraph<(), f64> {
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

/// All distances among some vertices by petgraph's Dijkstra, row by row.
#[must_use]
pub fn by_petgraph(graph: &UnGraph<(), f64>, among: &[u32]) -> Vec<f64> {
    let mut distances = Vec::with_capacity(among.len() * among.len());
    for &from in among {
        let reached = petgraph::algo::dijkstra(graph, from.into(), None, |edge| *edge.weight());
        distances.extend(
            among.iter().map(|&to| reached.get(&NodeIndex::from(to)).copied().unwrap_or(f64::INFINITY)),
        );
    }
    distances
}

/// All distances among some vertices, row by row, by a search with a binary heap and index-ordered arrays.
#[must_use]
pub fn by_heap(graph: &PathGraph, among: &[u32]) -> Vec<f64> {
    let mut distances = Vec::with_capacity(among.len() * among.len());
    let mut length = vec![f64::INFINITY; graph.vertex_count()];
    let mut waiting = BinaryHeap::new();
    for &from in among {
        length.fill(f64::INFINITY);
        if let Some(start) = length.get_mut(from as usize) {
            *start = 0.0;
            waiting.push(Reverse((0_u64, from)));
        }
        while let Some(Reverse((bits, vertex))) = waiting.pop() {
            let here = f64::from_bits(bits);
            if here > length[vertex as usize] {
                continue;
            }
            for (next, weight) in graph.neighbours(vertex) {
                if here + weight < length[next as usize] {
                    length[next as usize] = here + weight;
                    waiting.push(Reverse(((here + weight).to_bits(), next)));
                }
            }
        }
        let reached = |&to: &u32| length.get(to as usize).copied().unwrap_or(f64::INFINITY);
        distances.extend(among.iter().map(reached));
    }
    distances
}
