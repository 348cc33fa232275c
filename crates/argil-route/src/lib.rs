//! One layer: walls and support points into one closed cycle that never crosses itself.
//!
//! This is the path planning of Hergel, Hinz, Lefebvre and Thomaszewski, *Extrusion-Based Ceramics
//! Printing with Strictly-Continuous Deposition* (SIGGRAPH Asia 2019), section 3.3, with its
//! weak spots mended:
//!
//! 1. The walls cut the plane into *regions*: the free space between a loop and the loops that lie
//!    directly inside it ([`regions`]). Every demand belongs to the region that holds it.
//! 2. In each region the walls are joined by a cheapest tree that reuses strand which has to be
//!    printed anyway, and the other demands are served by closed *excursions* from any wall. One
//!    tour through everything competes with that plan, and the cheaper one stays. The paper fixes
//!    one connection point a wall before it knows the tour; its strands live three times as long.
//! 3. Every tour edge is drawn as its shortest path in a plane graph ([`argil_graph`]), so that the
//!    edges of all tours together with the walls form a plane multigraph in which every vertex has
//!    an even number of ends. Its *non-crossing Euler circuit* is the cycle: order and orientation of the walls
//!    fall out of it, and no crossing can arise, neither proper nor at a shared vertex.
//! 4. An edge that is walked twice becomes two *lanes* on the sides which the circuit gives them.
//!
//! The result is a [`Cycle`]: points, which of them must not move, what each stretch is for, and
//! which point carries which demand, ready for a smoothing stage such as `argil-elastic`.
//!
//! Lengths are in millimetres. Everything scales with [`RouteSettings::width`].
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
mod spine;
mod spliced;
mod straight;
mod tours;

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
