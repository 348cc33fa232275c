//! The elastic curve: shortens and smooths a path inside its support envelope.
#![forbid(unsafe_code)]

mod energies;
mod error;
mod guard;
mod neighbours;
mod newton;
mod objective;
mod options;
mod path;
mod rod;
mod system;

pub use error::ElasticError;
pub use glam::DVec2;
pub use newton::ElasticSolver;
pub use options::ElasticOptions;
pub use path::{Carrier, Clearance, Path, Relaxed, Stop};

/// Relaxes one layer's candidate cycle.
///
/// # Errors
/// Refuses lists of unequal length, points that are not finite, carriers that start outside their envelope and
/// options without meaning.
pub fn relax(path: &Path<'_>, options: &ElasticOptions) -> Result<Relaxed, ElasticError> {
    ElasticSolver::new().relax(path, options)
}
