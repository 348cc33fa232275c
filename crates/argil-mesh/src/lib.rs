#![doc = include_str!("../README.md")]
//!
//! # How it is built
//! [`read_stl`] turns bytes into triangles and checks them; [`Mesh::new`] welds, since the slicer
//! chains its sections along shared mesh edges and a soup of triangles shares none;
//! [`Mesh::oriented`] makes the windings of neighbours agree; [`Mesh::placed`] scales and moves.
//! [`EdgeTable`] is the topology that the slicer walks. Nothing here opens a file or prints.
//!
//! Lengths are millimetres, z is up.
#![forbid(unsafe_code)]

mod edges;
mod error;
mod mesh;
mod placement;
mod stl;
mod weld;
mod winding;

pub use edges::EdgeTable;
pub use error::MeshError;
pub use mesh::{Bounds, Mesh};
pub use placement::{Ground, Placement, Size};
pub use stl::read_stl;
