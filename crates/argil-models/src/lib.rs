#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod field;
mod gallery;
mod solid;
mod tetrahedra;

pub use field::Field;
pub use gallery::{arch, by_name, cactus, columns, cup, hanging_island, names, nested_rings, spire, table};
pub use glam::DVec3;
pub use solid::Solid;
pub use tetrahedra::{Bounds, ModelError, mesh_of};
