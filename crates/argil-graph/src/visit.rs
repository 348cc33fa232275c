//! The graph as petgraph's algorithms see it.

use std::collections::HashSet;
use std::iter::Copied;
use std::slice::Iter;

use petgraph::Directed;
use petgraph::visit::{
    Data, GraphBase, GraphProp, GraphRef, IntoEdgeReferences, IntoEdges, IntoNeighbors, IntoNodeIdentifiers,
    NodeCompactIndexable, NodeCount, NodeIndexable, Visitable,
};

use crate::PathGraph;

/// The directed graph of the steps that a path from one vertex may take: those of the path graph except
/// steps out of an attachment, unless the path begins there.
///
/// That attachments are not passed through is no property of an undirected graph, and a general algorithm
/// would not know it. So the view has a start, and petgraph's searches from that start are right.
///
/// # Example
/// ```
/// use argil_graph::{Edges, PathGraph, SeenFrom};
/// use glam::dvec2;
/// use petgraph::visit::IntoEdges;
///
/// let row = (0..3).map(|k| dvec2(f64::from(k), 0.0)).collect();
/// let graph = PathGraph::from_edges(row, &[1], &[], &[(0, 1, 2.0), (1, 2, 2.0)])?;
/// let seen: SeenFrom = graph.seen_from(0);
/// let mut steps: Edges = seen.edges(0);
/// assert_eq!(steps.next(), Some((0, 1, &2.0)));
/// let lengths = petgraph::algo::dijkstra(seen, 0, None, |edge| *edge.2);
/// assert_eq!((lengths.get(&1), lengths.get(&2)), (Some(&2.0), None));
/// # Ok::<(), argil_graph::GraphError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct SeenFrom<'g> {
    graph: &'g PathGraph,
    start: u32,
}

impl PathGraph {
    /// The steps that paths from `start` may take, for petgraph's algorithms.
    #[must_use]
    pub fn seen_from(&self, start: u32) -> SeenFrom<'_> {
        SeenFrom { graph: self, start }
    }
}

impl<'g> SeenFrom<'g> {
    fn steps(self, from: u32) -> (&'g [u32], &'g [f64]) {
        if from != self.start && self.graph.is_attachment(from) {
            (&[], &[])
        } else {
            self.graph.adjacency(from)
        }
    }
}

/// Steps of a [`SeenFrom`], as `(from, to, &weight)`: out of one vertex, or all of them.
#[derive(Clone, Debug)]
pub struct Edges<'g> {
    view: SeenFrom<'g>,
    from: u32,
    steps: std::iter::Zip<Iter<'g, u32>, Iter<'g, f64>>,
    /// One after the last vertex whose steps are wanted.
    end: u32,
}

impl<'g> Edges<'g> {
    fn new(view: SeenFrom<'g>, from: u32, end: u32) -> Self {
        let (targets, weights) = view.steps(from);
        Edges { view, from, steps: targets.iter().zip(weights), end }
    }
}

impl<'g> Iterator for Edges<'g> {
    type Item = (u32, u32, &'g f64);

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            if let Some((&to, weight)) = self.steps.next() {
                return Some((self.from, to, weight));
            }
            let following = self.from.checked_add(1).filter(|&v| v < self.end)?;
            *self = Edges::new(self.view, following, self.end);
        }
    }
}

impl GraphBase for SeenFrom<'_> {
    type EdgeId = (u32, u32);
    type NodeId = u32;
}

impl GraphRef for SeenFrom<'_> {}

impl Data for SeenFrom<'_> {
    type NodeWeight = ();
    type EdgeWeight = f64;
}

impl GraphProp for SeenFrom<'_> {
    type EdgeType = Directed;
}

impl Visitable for SeenFrom<'_> {
    type Map = HashSet<u32>;

    fn visit_map(&self) -> Self::Map {
        HashSet::new()
    }

    fn reset_map(&self, map: &mut Self::Map) {
        map.clear();
    }
}

impl NodeCount for SeenFrom<'_> {
    fn node_count(&self) -> usize {
        self.graph.vertex_count()
    }
}

impl NodeIndexable for SeenFrom<'_> {
    fn node_bound(&self) -> usize {
        self.graph.vertex_count()
    }

    fn to_index(&self, v: u32) -> usize {
        v as usize
    }

    fn from_index(&self, k: usize) -> u32 {
        k as u32
    }
}

impl NodeCompactIndexable for SeenFrom<'_> {}

impl IntoNodeIdentifiers for SeenFrom<'_> {
    type NodeIdentifiers = std::ops::Range<u32>;

    fn node_identifiers(self) -> Self::NodeIdentifiers {
        0..self.graph.vertex_count() as u32
    }
}

impl<'g> IntoNeighbors for SeenFrom<'g> {
    type Neighbors = Copied<Iter<'g, u32>>;

    fn neighbors(self, v: u32) -> Self::Neighbors {
        self.steps(v).0.iter().copied()
    }
}

impl<'g> IntoEdgeReferences for SeenFrom<'g> {
    type EdgeRef = (u32, u32, &'g f64);
    type EdgeReferences = Edges<'g>;

    fn edge_references(self) -> Self::EdgeReferences {
        Edges::new(self, 0, self.graph.vertex_count() as u32)
    }
}

impl<'g> IntoEdges for SeenFrom<'g> {
    type Edges = Edges<'g>;

    fn edges(self, v: u32) -> Self::Edges {
        Edges::new(self, v, v.saturating_add(1))
    }
}
