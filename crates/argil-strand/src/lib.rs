#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod bead;
mod error;
mod lengths;
mod rise;
mod role;
mod strand;

pub use bead::BeadShape;
pub use error::StrandError;
pub use glam::{DVec2, DVec3};
pub use lengths::{LayerSummary, RoleLengths};
pub use rise::Rise;
pub use role::Role;
pub use strand::{Move, Step, Strand, StrandLayer, SupportSource};
