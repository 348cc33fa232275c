//! Short closed tours over any symmetric metric: Or-opt, 2-opt, Or-3opt, exact when small.
#![forbid(unsafe_code)]

mod array_tour;
mod candidates;
mod construction;
mod contraction;
mod exact;
mod exchange;
mod kicks;
mod local_search;
mod metric;
mod options;
mod random;
mod solver;
mod tour;
mod work_queue;

pub use metric::{MatrixMetric, Metric, TourError};
pub use options::TourOptions;
pub use solver::{TourSolver, shortest_tour};
pub use tour::Tour;
