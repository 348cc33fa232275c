//! The five energies as functions of the fewest variables each depends on.
//!
//! Each answers with its value, its exact first derivative and a non-negative second derivative, all with respect
//! to one scalar (a length, a turning angle, a distance). The chain rule to vertex positions is the objective's.

/// Below this 1 + cos θ the bending energy goes on linearly in cos θ.
///
/// Eq. 3 has a pole at a reversal, and candidates contain reversals. 0.01 is a turn of 172°: sharper than
/// anything that survives a relaxation, so that the continuation changes no result, only keeps it finite. Smaller
/// values stiffen the system by the square.
const SHARPEST: f64 = 1e-2;

/// Exponent from which the clearance energy goes on linearly.
///
/// exp(20) is reached some 25 w inside the safeguard; beyond it only finiteness matters.
const DEEPEST: f64 = 20.0;

/// Share of the squared envelope next to the rim that counts as outside.
///
/// The barrier is infinite at the rim; the margin makes sure that a carrier judged inside in units of w is inside in
/// millimetres as well, whatever the rounding.
const RIM: f64 = 1e-9;

/// A function of one variable at one place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Jet {
    pub(crate) value: f64,
    /// First derivative.
    pub(crate) slope: f64,
    /// Model of the second derivative, never negative.
    pub(crate) curvature: f64,
}

/// Eq. 2 of one edge, as a function of its length: μ (l − T)² / 2T with T = α L. The curvature is exact.
pub(crate) fn stretch(weight: f64, target: f64, length: f64) -> Jet {
    let excess = length - target;
    let stiffness = weight / target;
    Jet { value: 0.5 * stiffness * excess * excess, slope: stiffness * excess, curvature: stiffness }
}

/// Eq. 3 at one vertex, as a function of the turning angle θ given by its cosine and sine: μ tan²(θ/2).
///
/// tan²(θ/2) = (1 − cos θ) / (1 + cos θ), whose derivative is 2 sin θ / (1 + cos θ)². Where 1 + cos θ falls under
/// [`SHARPEST`] the function continues along its tangent in cos θ: finite, still rising up to the reversal, and
/// with a continuous derivative (a clamp of the denominator alone would make reversals the *cheapest* turns).
/// The curvature is Gauss–Newton's: 2 (d tan(θ/2) / dθ)².
pub(crate) fn bend(weight: f64, cos: f64, sin: f64) -> Jet {
    let opening = 1.0 + cos;
    let clamped = opening.max(SHARPEST);
    let per_square = 2.0 * weight / (clamped * clamped);
    let value = weight * (2.0 - clamped) / clamped + per_square * (clamped - opening);
    Jet { value, slope: per_square * sin, curvature: per_square }
}

/// Eq. 5 at one vertex, as a function of the signed distance: μ exp(−β (d − ε)).
///
/// The curvature is that of the exponential; the field's own curvature is left out (Gauss–Newton), since it may
/// have either sign and the field need not offer it.
pub(crate) fn clear(weight: f64, sharpness: f64, kept: f64, distance: f64) -> Jet {
    let exponent = sharpness * (kept - distance);
    let bounded = exponent.min(DEEPEST);
    let scale = weight * bounded.exp();
    Jet {
        value: scale * (1.0 + (exponent - bounded)),
        slope: -scale * sharpness,
        curvature: scale * sharpness * sharpness,
    }
}

/// Eq. 6 as it must be meant, as a function of the squared distance q: −μ log(1 − q/ε²).
///
/// The paper prints a positive logarithm of a negative number. `None` outside the envelope. The slope is with
/// respect to q and so is the exact curvature.
pub(crate) fn barrier(weight: f64, envelope: f64, square: f64) -> Option<Jet> {
    let limit = envelope * envelope;
    let room = 1.0 - square / limit;
    if room > RIM {
        let slope = weight / (limit * room);
        Some(Jet { value: -weight * room.ln(), slope, curvature: slope / (limit * room) })
    } else {
        None
    }
}

/// Repulsion of a vertex from the nearest strand, as a function of their distance under one bead width:
/// μ (1 − d)² / 2. The curvature is exact along the line of sight.
pub(crate) fn repel(weight: f64, distance: f64) -> Jet {
    let overlap = (1.0 - distance).max(0.0);
    let curvature = if overlap > 0.0 { weight } else { 0.0 };
    Jet { value: 0.5 * weight * overlap * overlap, slope: -weight * overlap, curvature }
}
