//! Readers of file formats: bytes into a [`Soup`](crate::Soup).

mod stl;
mod words;

pub use stl::{read_stl, stl};
