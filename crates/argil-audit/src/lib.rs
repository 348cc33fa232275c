#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod audit;
mod bead;
mod contact;
mod coverage;
mod crossings;
mod crowding;
mod cycle;
mod error;
mod figures;
mod finding;
mod motion;
mod passage;
mod region;
mod report;
mod sampling;
mod settings;
mod strand;
mod support;
mod turns;
mod wanted;

pub use audit::audit;
pub use error::AuditError;
pub use figures::{Amount, Figures};
pub use finding::{Finding, FindingKind};
pub use report::{Report, Shortfall};
pub use settings::AuditSettings;
