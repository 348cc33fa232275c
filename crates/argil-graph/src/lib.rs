//! Triangulated free space between walls, with exact shortest paths and distances.
#![forbid(unsafe_code)]

mod construction;
mod error;
mod graph;
mod matrix;
mod search;
mod space;
mod thinning;
mod triangulation;

pub use error::{GraphError, PointKind};
pub use graph::PathGraph;
pub use matrix::DistanceMatrix;
pub use space::{FreeSpace, Nodes};
