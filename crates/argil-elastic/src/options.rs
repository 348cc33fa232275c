//! Weights and limits of the relaxation.

use crate::ElasticError;

/// Weights, reaches and limits of the relaxation.
///
/// Lengths are in bead widths w unless a field says otherwise, and the energy is in units of w too. The paper
/// gives its weights in millimetres at w = 1.5 mm; taken over unchanged they would shift the balance of a 30 mm
/// concrete bead by a factor of 400 (Eq. 2 grows like a length, Eq. 3 like an inverse length, Eq. 6 not at all).
/// Divided by the powers of w noted at each field, a print scaled by any factor relaxes to the scaled result.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct ElasticOptions {
    /// Bead width w in mm, the unit of everything below. 1.5 mm in the paper.
    pub width: f64,
    /// Radius ε of the disc about an anchor that a carrier never leaves (Eq. 6), in **mm**.
    ///
    /// 0.3 w in the paper (`ε_across`). Smaller keeps more of the bead above on the bead below, larger lets strands
    /// shorten faster from layer to layer.
    pub envelope: f64,
    /// `α_l` of Eq. 2: every edge pulls towards this share of its candidate length. 0.9 in the paper.
    pub target_ratio: f64,
    /// `μ_length` of Eq. 2. 10 in the paper; needs no power of w.
    pub length: f64,
    /// `μ_bend` of Eq. 3, in w²: 0.3 mm² / (1.5 mm)².
    ///
    /// The paper has 0.01 mm², a thousandth of the tension, which leaves every corner of the candidate standing.
    /// Repulsion needs stiffer strands than that, or they wiggle between their carriers.
    pub bend: f64,
    /// `μ_dev` of Eq. 6, in w: 0.001 mm / 1.5 mm. Tiny on purpose: a wall, felt only close to the rim.
    pub deviation: f64,
    /// `μ_clear` of Eq. 5, in w: 0.01 mm / 1.5 mm. A hundred times more halves no contact and doubles the strand.
    pub clearance: f64,
    /// β of Eq. 5, per w: 0.5 / mm · 1.5 mm. Larger makes the clearance a harder wall.
    pub sharpness: f64,
    /// `ε_model` of Eq. 5, the clearance kept from the safeguard. 2 w in the paper.
    pub clear_distance: f64,
    /// μ of the repulsion between strands nearer than w, per w: 1 / mm · 1.5 mm. Not in the paper.
    ///
    /// Without it two strands of a corridor fall onto each other; three times as much keeps strands from dying out.
    pub repulsion: f64,
    /// Along the path, how far apart two places must be to repel each other. 2 w.
    ///
    /// Shorter, and the two sides of an ordinary bend push each other open.
    pub repulsion_skip: f64,
    /// A strand that was not this near to a wall in the candidate does not come as near. 0.067 w (0.1 mm).
    pub touch: f64,
    /// Newton iterations at most. The lagged choice of nearest strands seldom settles to the last digit and the
    /// next layer does not gain by it, so this is the usual end. 12.
    pub max_iterations: usize,
    /// The relaxation has converged when the Newton step moves no vertex further. 5e-3 mm / 1.5 mm.
    pub tolerance: f64,
    /// No vertex moves further in one iteration. 0.5 mm / 1.5 mm.
    pub max_step: f64,
}

impl ElasticOptions {
    /// The defaults for a bead of `width` mm, with the paper's envelope of 0.3 w.
    ///
    /// # Example
    /// ```
    /// let concrete = argil_elastic::ElasticOptions::for_width(30.0);
    /// assert_eq!(concrete.envelope, 9.0);
    /// assert_eq!(concrete.length, argil_elastic::ElasticOptions::default().length);
    /// ```
    #[must_use]
    pub fn for_width(width: f64) -> Self {
        Self {
            width,
            envelope: 0.3 * width,
            target_ratio: 0.9,
            length: 10.0,
            bend: 0.3 / (1.5 * 1.5),
            deviation: 0.001 / 1.5,
            clearance: 0.01 / 1.5,
            sharpness: 0.5 * 1.5,
            clear_distance: 2.0,
            repulsion: 1.5,
            repulsion_skip: 2.0,
            touch: 0.067,
            max_iterations: 12,
            tolerance: 5e-3 / 1.5,
            max_step: 0.5 / 1.5,
        }
    }

    /// Refuses values for which an energy or a step has no meaning.
    pub(crate) fn check(&self) -> Result<(), ElasticError> {
        let positive = [
            ("width", self.width),
            ("envelope", self.envelope),
            ("target_ratio", self.target_ratio),
            ("length", self.length),
            ("max_step", self.max_step),
        ];
        for (option, value) in positive {
            if !(value > 0.0 && value.is_finite()) {
                return Err(ElasticError::BadOption { option, value, expected: "finite and positive" });
            }
        }
        let not_negative = [
            ("bend", self.bend),
            ("deviation", self.deviation),
            ("clearance", self.clearance),
            ("sharpness", self.sharpness),
            ("repulsion", self.repulsion),
            ("repulsion_skip", self.repulsion_skip),
            ("touch", self.touch),
            ("tolerance", self.tolerance),
        ];
        for (option, value) in not_negative {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(ElasticError::BadOption { option, value, expected: "finite and not negative" });
            }
        }
        if !self.clear_distance.is_finite() {
            return Err(ElasticError::BadOption {
                option: "clear_distance",
                value: self.clear_distance,
                expected: "finite",
            });
        }
        Ok(())
    }
}

impl Default for ElasticOptions {
    fn default() -> Self {
        Self::for_width(1.5)
    }
}
