#![doc = include_str!("../README.md")]
//!
//! # How it is built
//! Readers turn bytes into a [`Soup`] of triangles; [`Mesh::new`] checks and welds, since the slicer
//! chains its sections along shared mesh edges and a soup of triangles shares none;
//! [`Mesh::oriented`] makes the windings of neighbours agree and shells face outwards; [`Soup::repaired`] does both and
//! counts what it mended, with places, as [`Repairs`]; [`Mesh::placed`] scales and moves.
//! [`EdgeTable`] is the topology that the slicer walks. Nothing here opens a file or prints.
//!
//! Lengths are millimetres, z is up.
#![forbid(unsafe_code)]

mod cuboid;
mod duplicates;
mod edges;
mod error;
mod formats;
mod mesh;
mod nesting;
mod normal;
mod placement;
mod remark;
mod repairs;
mod shells;
mod soup;
mod unit;
mod weld;
mod winding;

pub use edges::EdgeTable;
pub use error::MeshError;
#[cfg(feature = "3mf")]
pub use formats::three_mf;
pub use formats::{Format, obj, ply, read_stl, stl};
pub use mesh::{Bounds, Mesh};
pub use placement::{Ground, Placement, Size};
pub use remark::Remark;
pub use repairs::{Places, Repairs};
pub use soup::Soup;
pub use unit::Unit;
