#![doc = include_str!("../README.md")]
//!
//! # In a picture
//!
#![doc = include_str!("../pictures/relaxed.svg")]
//!
//! A path with the corners that a graph gives it, dashed, and what it relaxes to. Two of its points hold something, and stay in their discs.
#![forbid(unsafe_code)]

mod band;
mod energies;
mod error;
mod guard;
mod imls;
mod neighbours;
mod newton;
mod objective;
mod options;
mod paper;
mod path;
mod rod;
mod system;

pub use error::ElasticError;
pub use glam::DVec2;
pub use imls::ImlsField;
pub use newton::ElasticSolver;
pub use options::ElasticOptions;
pub use paper::relax_literally;
pub use path::{Carrier, Clearance, Path, Relaxed, Stop};

/// Relaxes one layer's candidate cycle: shortens and smooths its free runs (Sec. 3.4, "Path Optimization").
///
/// Minimises the sum of Eq. 2 (length), 3 (bending), 5 (clearance) and 6 (envelope) and of a repulsion between
/// strands by Newton's method, all free vertices in one sparse system. A step is accepted only if it
/// - lowers the energy, by at least a little of what the gradient promises,
/// - leaves every carrier inside the discs about its anchors,
/// - makes no two edges cross that did not cross in the candidate, and
/// - brings no strand nearer than [`ElasticOptions::touch`] to a wall that it did not touch in the candidate.
///
/// Where a step would do otherwise it is cut back at that place only. A path with fewer than three points or no
/// free vertex is returned as it is. Fixed vertices are returned bit by bit.
///
/// # Errors
/// [`ElasticError`] for lists of unequal length, points that are not finite, carriers that start outside their
/// envelope, and options for which an energy or a step has no meaning.
///
/// # Complexity
/// For n vertices spaced about w/2, O(n) an iteration plus the calls of [`Clearance::distance`]; nothing is allocated
/// after the first position has been judged, save where strands crowd more than ever before.
///
/// # Example
/// ```
/// use argil_elastic::{Carrier, DVec2, ElasticOptions, Path, relax};
/// // A wall (fixed) from which a hairpin leaves to hold one point of the layer above.
/// let wall = [(0.0, 0.0), (-4.0, 0.0), (-4.0, -6.0), (4.0, -6.0), (4.0, 0.0), (1.0, 0.0)];
/// let pin = [(1.1, 0.8), (0.9, 1.6), (1.2, 2.4), (0.5, 3.0), (-0.2, 2.3), (0.1, 1.5), (-0.1, 0.7)];
/// let points: Vec<DVec2> = wall.iter().chain(&pin).copied().map(DVec2::from).collect();
/// let fixed: Vec<bool> = (0..points.len()).map(|k| k < wall.len()).collect();
/// let tip = Carrier { vertex: 9, anchor: DVec2::new(0.5, 3.1) };
/// let path = Path { points: &points, fixed: &fixed, carriers: &[tip], clear_of: None, felt: &[] };
///
/// let relaxed = relax(&path, &ElasticOptions::default())?;
/// assert!(relaxed.energy_after < relaxed.energy_before);
/// assert_eq!(relaxed.points[..6], points[..6]);
/// assert!(relaxed.points[9].distance(tip.anchor) < 0.45);
/// # Ok::<(), argil_elastic::ElasticError>(())
/// ```
pub fn relax(path: &Path<'_>, options: &ElasticOptions) -> Result<Relaxed, ElasticError> {
    ElasticSolver::new().relax(path, options)
}
