//! Turns a mesh into one continuous deposition path: no transfer move from the first gram of clay to the last.
//!
//! A clay printer cannot stop extruding and hop. This crate plans prints that never have to: for every layer one
//! closed cycle through all walls, with support for the layer above built into the same strand, and from layer to layer one
//! short step that extrudes while it rises. The method is that of Hergel, Hinz, Lefebvre and Thomaszewski,
//! *Extrusion-Based Ceramics Printing with Strictly-Continuous Deposition* (SIGGRAPH Asia 2019), mended where
//! its text leads to unsound prints.
//!
//! [`Planner`] runs the stages; each of them is a crate of its own and stands behind a trait of [`stages`], so
//! that any of them can be replaced. [`Planner::default`] has argil's own, [`literal::planner`] the paper's text as it
//! stands.
//!
//! ```
//! use argil::{Planner, Settings};
//!
//! let cup = argil_models::by_name("columns").expect("a bundled model").to_stl();
//! let mesh = argil::mesh::read_stl(&cup)?;
//! let plan = Planner::default().plan(&mesh, &Settings::for_width(2.0))?;
//! assert!(plan.strand.length() > 0.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Lengths are in millimetres. The same input gives the same bytes.
#![forbid(unsafe_code)]

mod ascent;
mod blunt;
mod clearance;
mod climb;
mod descent;
#[cfg(feature = "serde")]
mod document;
mod ends;
mod error;
mod flow;
mod foothold;
mod hold;
pub mod literal;
mod model;
mod opening;
mod passage;
mod plan;
mod planner;
mod precedence;
mod settings;
mod settle;
mod skirt;
mod spiral;
pub mod stages;
mod starts;
mod watch;

pub use argil_curve as curve;
pub use argil_elastic as elastic;
pub use argil_fill as fill;
pub use argil_gcode as gcode;
pub use argil_mesh as mesh;
pub use argil_route as route;
pub use argil_route::{graph, tour};
pub use argil_safeguard as safeguard;
pub use argil_seam as seam;
pub use argil_skin as skin;
pub use argil_slice as slice;
pub use argil_strand as strand;
pub use argil_support as support;
pub use argil_taut as taut;

#[cfg(feature = "serde")]
pub use document::Document;
pub use error::{LayerFault, PlanError};
pub use plan::{Climb, InfillChoice, LayerReport, LevelCause, Plan, SkirtLaid, StageTimes};
pub use planner::{Planner, Progress};
pub use settings::{Bed, Infill, Material, Settings, Skirt, WallOrder};

/// The examples of the pages for readers, so that they stay true.
#[cfg(doctest)]
mod pages {
    #[doc = include_str!("../README.md")]
    struct Crate;
    #[doc = include_str!("../../../README.md")]
    struct Workspace;
    #[doc = include_str!("../../../docs/SLICERS.md")]
    struct Slicers;
}
