//! An upright wall to be measured and weighed.

use std::f64::consts::PI;

use argil_strand::{DVec2, Strand};

use crate::layers::{seam_shift, strand};
use crate::{CalibrateError, Calibration};

/// Half of the length of a straight side, bead widths: room for a calliper away from the ends.
const HALF_SIDE: f64 = 12.0;

/// Radius of the round ends, bead widths.
const ROUND: f64 = 6.0;

/// Chords of a round end: about one a bead.
const CHORDS: usize = 18;

/// Layers: high enough to be held by a calliper above the widened foot.
const LAYERS: usize = 8;

pub(crate) fn ring(calibration: &Calibration) -> Result<Strand, CalibrateError> {
    strand(calibration, (0..LAYERS).map(|layer| cycle(calibration.width, layer)))
}

/// The cycle of a layer about the origin, from the seam in the front side on.
fn cycle(width: f64, layer: usize) -> Vec<DVec2> {
    let end = |side: f64, from: f64| {
        (0..=CHORDS).map(move |chord| {
            let angle = from + PI * chord as f64 / CHORDS as f64;
            DVec2::new(side * HALF_SIDE, 0.0) + DVec2::from_angle(angle) * ROUND
        })
    };
    let seam = DVec2::new(seam_shift(layer), -ROUND);
    [seam].into_iter().chain(end(1.0, -PI / 2.0)).chain(end(-1.0, PI / 2.0)).map(|p| p * width).collect()
}
