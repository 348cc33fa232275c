//! Benchmarks of argil on generated instances.
//!
//! What is measured stands in `benches/`; here is what it is measured on. Instances come from a seed and nothing else,
//! so that figures of two machines or two versions are of the same work. `cargo bench -p argil-benches --bench tour`
//! measures, `-- --test` after it runs each once. Lengths are in millimetres, the bead width is that of the paper.
#![forbid(unsafe_code)]

mod baseline;
mod cycle;
mod instance;
mod layer;
mod metric;
mod random;

pub use argil_curve::DVec2;
pub use baseline::{by_heap, by_petgraph, petgraph_of};
pub use cycle::Excursions;
pub use instance::Instance;
pub use layer::MixedLayer;
pub use metric::{Lengths, Rows};
pub use random::SplitMix;

/// Bead width w of all instances, mm: that of the paper.
pub const WIDTH: f64 = 1.5;
