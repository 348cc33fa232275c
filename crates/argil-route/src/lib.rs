#![doc = include_str!("../README.md")]
//!
//! # In a picture
//!
#![doc = include_str!("../pictures/cycle.svg")]
//!
//! Two bodies, one of them with a window, and seven demands: walls are terracotta, support blue and joints ochre.
//!
//! Everything scales with [`RouteSettings::width`]. The result is ready for a smoothing stage such as `argil-elastic`.
#![forbid(unsafe_code)]

mod attachment;
mod circuit;
mod cycle;
mod discs;
mod error;
mod excursion;
mod joint;
mod lane;
mod layer;
mod multigraph;
mod region;
mod region_plan;
mod relaxation;
mod round_tour;
mod settings;
mod sketch;
mod spine;
mod spliced;
mod straight;
mod tours;

pub use argil_curve::{ClosedCurve, DVec2, SegmentIndex};
pub use argil_graph as graph;
pub use argil_tour as tour;
pub use argil_tour::{Metric, TourOptions};

pub use cycle::{Cycle, Leg};
pub use error::RouteError;
pub use layer::{Demand, LayerInput, Router, Wall};
pub use region::{Region, regions};
pub use settings::RouteSettings;
pub use spliced::SplicedRouter;
pub use tours::{ShortestTours, TourDistances, Tours};
