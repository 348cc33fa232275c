//! Triangulated free space between walls, with exact shortest paths and distances.
#![forbid(unsafe_code)]

mod construction;
mod error;
mod graph;
mod hierarchy;
mod matrix;
mod path_finder;
mod space;
mod sweeps;
mod thinning;
mod triangulation;

pub use error::{GraphError, PointKind};
pub use graph::PathGraph;
pub use matrix::DistanceMatrix;
pub use path_finder::PathFinder;
pub use space::{FreeSpace, Nodes};
