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
        value: scale * (1.0 + (exponent - DEEPEST).max(0.0)),
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

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// First and second central differences.
    fn differences(f: impl Fn(f64) -> f64, at: f64) -> (f64, f64) {
        let h = 1e-4 * (1.0 + at.abs());
        ((f(at + h) - f(at - h)) / (2.0 * h), (f(at + h) - 2.0 * f(at) + f(at - h)) / (h * h))
    }

    fn close(a: f64, b: f64) -> bool {
        (a - b).abs() <= 2e-5 * (1.0 + a.abs().max(b.abs()))
    }

    proptest! {
        #[test]
        fn stretch_has_exact_derivatives(target in 0.1..2.0_f64, length in 0.01..3.0_f64) {
            let (slope, curvature) = differences(|l| stretch(10.0, target, l).value, length);
            let jet = stretch(10.0, target, length);
            prop_assert!(close(jet.slope, slope) && close(jet.curvature, curvature));
        }

        #[test]
        fn bend_has_an_exact_slope_and_the_curvature_of_gauss_newton(angle in -2.8..2.8_f64) {
            let (slope, _) = differences(|t| bend(0.7, t.cos(), t.sin()).value, angle);
            let (tangent, _) = differences(|t| (0.5 * t).tan(), angle);
            let jet = bend(0.7, angle.cos(), angle.sin());
            prop_assert!((jet.value - 0.7 * (0.5 * angle).tan().powi(2)).abs() <= 1e-9 * (1.0 + jet.value));
            prop_assert!((jet.slope - slope).abs() <= 1e-3 * (1.0 + slope.abs()));
            prop_assert!((jet.curvature - 1.4 * tangent * tangent).abs() <= 1e-3 * jet.curvature);
        }

        #[test]
        fn clear_has_exact_derivatives(distance in -20.0..30.0_f64) {
            let (slope, curvature) = differences(|d| clear(0.5, 0.75, 2.0, d).value, distance);
            let jet = clear(0.5, 0.75, 2.0, distance);
            prop_assert!((jet.slope - slope).abs() <= 1e-5 * jet.value.max(1.0));
            prop_assert!((jet.curvature - curvature).abs() <= 1e-4 * jet.value.max(1.0));
        }

        #[test]
        fn barrier_has_exact_derivatives(square in 0.0..0.8_f64) {
            let value = |q: f64| barrier(0.3, 1.0, q).map_or(f64::NAN, |jet| jet.value);
            let (slope, curvature) = differences(value, square);
            let jet = barrier(0.3, 1.0, square).unwrap();
            prop_assert!(close(jet.slope, slope) && (jet.curvature - curvature).abs() <= 1e-3 * jet.curvature);
        }

        #[test]
        fn repel_has_exact_derivatives(distance in 0.0..0.99_f64) {
            let (slope, curvature) = differences(|d| repel(1.5, d).value, distance);
            let jet = repel(1.5, distance);
            prop_assert!(close(jet.slope, slope) && close(jet.curvature, curvature));
        }
    }

    #[test]
    fn a_reversal_is_finite_and_the_dearest_turn() {
        let mut last = -1.0;
        for step in 0..=1800 {
            let angle = (f64::from(step) * 0.1).to_radians();
            let jet = bend(1.0, angle.cos(), angle.sin());
            assert!(jet.value > last && jet.value.is_finite(), "{step}");
            assert!(jet.slope >= 0.0 && jet.curvature > 0.0);
            last = jet.value;
        }
    }

    #[test]
    fn the_barrier_ends_at_the_rim() {
        assert!(barrier(1.0, 0.3, 0.09).is_none());
        assert!(barrier(1.0, 0.3, 0.0899).is_some());
    }

    #[test]
    fn the_clearance_is_finite_however_deep() {
        assert!(clear(1.0, 0.75, 2.0, -1e9).value.is_finite());
        assert_eq!(clear(1.0, 0.75, 2.0, f64::INFINITY).value, 0.0);
    }
}
