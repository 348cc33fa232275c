#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod bead;
mod lengths;
mod role;
mod strand;

pub use bead::BeadShape;
pub use glam::{DVec2, DVec3};
pub use lengths::{LayerSummary, RoleLengths};
pub use role::Role;
pub use strand::{Move, Step, Strand, StrandError, StrandLayer, SupportSource};
