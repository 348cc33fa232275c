#![doc = include_str!("../README.md")]
//!
//! # In a picture
//!
#![doc = include_str!("../pictures/path-graph.svg")]
//!
//! The free space between two obstacles inside an outer loop: the graph, and the shortest path between two terminals. Ochre is an attachment.
#![forbid(unsafe_code)]

mod bits;
mod construction;
mod distances;
mod elimination;
mod error;
mod graph;
mod hierarchy;
mod labels;
mod lists;
mod matrix;
mod nearby;
mod path_finder;
mod space;
mod sweeps;
mod thinning;
mod triangulation;
mod vectors;
#[cfg(feature = "petgraph")]
mod visit;

pub use distances::Distances;
pub use error::{GraphError, PointKind};
pub use glam::DVec2;
pub use graph::PathGraph;
pub use labels::DistanceLabels;
pub use matrix::DistanceMatrix;
pub use path_finder::PathFinder;
pub use space::{FreeSpace, Nodes};
#[cfg(feature = "petgraph")]
pub use visit::{Edges, SeenFrom};
