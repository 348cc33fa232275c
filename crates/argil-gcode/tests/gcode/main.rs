//! The writer and the reader of g-code.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking, also outside of its own function")]

mod arcs;
mod extrusion;
mod file;
mod numbers;
mod reader;
mod round_trip;
mod strands;
