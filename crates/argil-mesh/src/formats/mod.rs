//! Readers of file formats: bytes into a [`Soup`](crate::Soup).

mod format;
#[cfg(feature = "3mf")]
mod model_part;
mod obj;
#[cfg(feature = "3mf")]
mod package;
mod ply;
mod stl;
#[cfg(feature = "3mf")]
mod three_mf;
#[cfg(feature = "3mf")]
mod transform;
mod words;

pub use format::Format;
pub use obj::obj;
pub use ply::ply;
pub use stl::{read_stl, stl};
#[cfg(feature = "3mf")]
pub use three_mf::three_mf;
