//! Sharp turns, where a bead piles up and drags.

use crate::settings::Tolerance;
use crate::wanted::Wanted;
use argil_curve::DVec2;

/// Steps shorter than this, mm, have no direction.
const NO_STEP: f64 = 1e-6;
/// A turn by more than this, in degrees, is sharp.
const SHARP: f64 = 135.0;

/// Place and angle in degrees of every sharp turn apart from the model's own.
pub(crate) fn sharp_turns(points: &[DVec2], wanted: &Wanted, tolerance: &Tolerance) -> Vec<(DVec2, f64)> {
    let steps: Vec<(DVec2, DVec2)> = points
        .windows(2)
        .map(|pair| (pair[1], pair[1] - pair[0]))
        .filter(|(_, step)| step.length() > NO_STEP)
        .collect();
    steps
        .windows(2)
        .map(|pair| (pair[0].0, pair[0].1.angle_to(pair[1].1).abs().to_degrees()))
        .filter(|&(at, angle)| angle > SHARP && wanted.wall_distance(at) > tolerance.on_wall)
        .collect()
}
