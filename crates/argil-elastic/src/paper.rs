//! The paper's text to the letter, to measure what the mended energies are worth.

use crate::newton::{ElasticSolver, Reading};
use crate::{ElasticError, ElasticOptions, Path, Relaxed};

impl ElasticOptions {
    /// The weights that the paper prints, for a bead of `width` mm.
    ///
    /// They differ from [`ElasticOptions::for_width`] in the bending weight (0.01 mm² at w = 1.5 mm), in having no
    /// repulsion, and in the 20 iterations within which the paper's solver converges.
    #[must_use]
    pub fn literal(width: f64) -> Self {
        Self { bend: 0.01 / (1.5 * 1.5), repulsion: 0.0, max_iterations: 20, ..Self::for_width(width) }
    }
}

/// Relaxes a path as Sec. 3.4 has it, word for word.
///
/// Eq. 6 holds **every** free vertex within [`ElasticOptions::envelope`] of its candidate position along the normal
/// of the path there, and lets it slide along the tangent; [`Path::carriers`] are not looked at. The one deviation
/// from the print is its sign: Eq. 6 as printed takes the logarithm of a number that is negative wherever the path may
/// be, and −log(1 − d²/ε²) is what its text describes. There is no repulsion, whatever the options say, and no guard
/// against crossings: hairpins retract, strands fall onto each other, and what they held is lost. That is what this
/// function is for: to count it. For the field of Eq. 4 pass an [`ImlsField`](crate::ImlsField) as
/// [`Path::clear_of`].
///
/// # Errors
/// As [`relax`](crate::relax), except that carriers are not checked against the envelope.
///
/// # Complexity
/// As [`relax`](crate::relax).
///
/// # Example
/// ```
/// use argil_elastic::{DVec2, ElasticOptions, Path, relax_literally};
/// // A strand with a corner, held at both ends; the long way back is a wall.
/// let points: Vec<DVec2> = [(0.0, 0.0), (0.7, 0.0), (1.4, 0.0), (1.4, 0.7), (1.4, 1.4), (0.0, 1.4)]
///     .map(DVec2::from)
///     .to_vec();
/// let fixed = [true, false, false, false, true, true];
/// let path = Path { points: &points, fixed: &fixed, carriers: &[], clear_of: None, felt: &[] };
/// let relaxed = relax_literally(&path, &ElasticOptions::literal(1.5))?;
/// let length = |p: &[DVec2]| p.windows(2).map(|e| e[0].distance(e[1])).sum::<f64>();
/// assert!(length(&relaxed.points) < length(&points));
/// # Ok::<(), argil_elastic::ElasticError>(())
/// ```
pub fn relax_literally(path: &Path<'_>, options: &ElasticOptions) -> Result<Relaxed, ElasticError> {
    let options = ElasticOptions { repulsion: 0.0, ..*options };
    ElasticSolver::new().relax_as(Reading::Literal, path, &options)
}
