#![doc = include_str!("../README.md")]
//!
//! # How it is built
//! `motion` reads the moves and counts what breaks the strand, `cycle` makes paths of them and finds where
//! each layer's cycle begins. `wanted` is what the model asks of a layer, `strand` the path sample by sample
//! beside it. The measures follow, one a file: `coverage`, `support`, `crossings`, `passage`, `contact`,
//! `crowding`, `bead`, `turns`, `coherence`; `ledger` gathers contact over layers, `section` the corners of the
//! mesh on a layer's plane; `audit` leads them through the layers and sums up. Terms are those of Sections 3.2 to
//! 3.4 of the paper.
#![forbid(unsafe_code)]

mod audit;
mod bead;
mod closure;
mod coherence;
mod contact;
mod coverage;
mod crossings;
mod crowding;
mod cycle;
mod error;
mod figures;
mod finding;
mod ledger;
mod motion;
mod passage;
mod region;
mod report;
mod rise;
mod sampling;
mod section;
mod settings;
mod strand;
mod support;
mod turns;
mod wanted;

pub use argil_curve::DVec2;
pub use argil_gcode as gcode;
pub use argil_slice::mesh;
pub use audit::audit;
pub use error::AuditError;
pub use figures::{Amount, Figures};
pub use finding::{Finding, FindingKind};
pub use ledger::{ContactCause, ContactPlace};
pub use report::{Report, Shortfall};
pub use settings::AuditSettings;
