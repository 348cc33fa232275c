//! One layer of path planning as a file: a graph with lengths in whole micrometres.

use argil_curve::DVec2;
use argil_graph::{GraphError, PathGraph};
use serde::{Deserialize, Serialize};

use crate::MixedLayer;

/// How far from its place in the layer above a terminal may lie, mm: `ε_across` of the paper's clay, and the grid.
const SAME: f64 = 0.46;

/// A layer as its JSON has it. Distances in it are whole numbers, so that all solvers must agree to the unit.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Instance {
    /// What it is called.
    #[serde(default)]
    pub name: String,
    /// Where the vertices are, mm.
    pub vertices: Vec<(f64, f64)>,
    /// Pairs of vertices and the length of the edge between them, µm.
    pub edges: Vec<(u32, u32, f64)>,
    /// The vertices that the tour visits.
    pub terminals: Vec<u32>,
}

impl Instance {
    /// The layer that a text describes.
    ///
    /// # Errors
    /// What serde says of a text that is no layer.
    pub fn from_json(text: &str) -> Result<Self, serde_json::Error> {
        serde_json::from_str(text)
    }

    /// A layer made from a seed, with lengths rounded to whole micrometres.
    ///
    /// # Errors
    /// As for [`MixedLayer::graph`].
    pub fn made(terminals: usize, seed: u64) -> Result<Self, GraphError> {
        let graph = MixedLayer::new(terminals, seed).graph()?;
        Ok(Self {
            name: format!("mixed_{terminals}"),
            vertices: graph.positions().iter().map(|&p| p.into()).collect(),
            edges: graph
                .edges()
                .filter(|&(a, b, _)| !graph.is_attachment(a) && !graph.is_attachment(b))
                .map(|(a, b, length)| (a, b, (1e3 * length).round()))
                .collect(),
            terminals: (0..terminals).map(|k| graph.terminal(k)).collect(),
        })
    }

    /// Its graph.
    ///
    /// # Errors
    /// As [`PathGraph::from_edges`].
    pub fn graph(&self) -> Result<PathGraph, GraphError> {
        let positions = self.vertices.iter().map(|&p| DVec2::from(p)).collect();
        PathGraph::from_edges(positions, &[], &self.terminals, &self.edges)
    }

    /// The terminals in the order in which a tour of the layer above visits them: each has the place of the nearest
    /// terminal there, if there is one within a drift from layer to layer. Others are left out.
    #[must_use]
    pub fn order_of(&self, above: &Instance, tour: &[usize]) -> Vec<usize> {
        let place = |layer: &Instance, k: usize| {
            let vertex = layer.terminals.get(k).and_then(|&v| layer.vertices.get(v as usize));
            vertex.map_or(DVec2::NAN, |&p| DVec2::from(p))
        };
        // The places of the tour by x, so that few are looked at for each terminal.
        let mut visited: Vec<(f64, f64, usize)> =
            tour.iter().map(|&k| place(above, k)).enumerate().map(|(turn, p)| (p.x, p.y, turn)).collect();
        visited.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut order: Vec<(usize, usize)> = Vec::new();
        for k in 0..self.terminals.len() {
            let p = place(self, k);
            let first = visited.partition_point(|v| v.0 < p.x - SAME);
            let near = visited[first..].iter().take_while(|v| v.0 <= p.x + SAME);
            let nearest = near
                .map(|v| (p.distance(DVec2::new(v.0, v.1)), v.2))
                .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            if let Some((distance, turn)) = nearest
                && distance <= SAME
            {
                order.push((turn, k));
            }
        }
        order.sort_unstable();
        order.into_iter().map(|(_, k)| k).collect()
    }
}
