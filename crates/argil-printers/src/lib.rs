#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod error;
mod fact;
mod material;
mod printer;
mod template;

pub use error::ProfileError;
pub use fact::Fact;
pub use material::{Material, materials};
pub use printer::{Bead, Flavour, Origin, Printer, Volume, printers};
pub use template::render;
