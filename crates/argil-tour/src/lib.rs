//! Short closed tours over any symmetric metric: Or-opt, 2-opt, Or-3opt, exact when small.
#![forbid(unsafe_code)]

mod array_tour;
mod candidates;
mod construction;
mod exact;
mod kicks;
mod metric;
mod options;
mod or_3opt;
mod random;
mod solver;
mod tour;

pub use metric::{MatrixMetric, Metric, TourError};
pub use options::TourOptions;
pub use solver::{TourSolver, shortest_tour};
pub use tour::Tour;
