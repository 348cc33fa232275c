#![doc = include_str!("../README.md")]
//!
//! # In a picture
//!
#![doc = include_str!("../pictures/tour.svg")]
//!
//! Seventy-two places in one closed tour.
//!
//! The tour is the one through terminals and connection points of Sec. 3.3 of the paper, which takes it from an
//! off-the-shelf solver. Here it may start from the layer above, and differs from it only where that is shorter.
#![forbid(unsafe_code)]
#![no_std]

extern crate alloc;

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
mod remembered;
mod solver;
mod tour;
mod work_queue;

pub use metric::{MatrixMetric, Metric, TourError};
pub use options::TourOptions;
pub use solver::{TourSolver, shortest_tour};
pub use tour::Tour;
