//! A ring of sectors that lean out more and more.

use std::f64::consts::TAU;

use argil_strand::{DVec2, Strand};

use crate::layers::{seam_shift, strand};
use crate::{CalibrateError, Calibration};

/// How far the sectors of [`Calibration::fan`] lean out, in bead widths a layer, in the order of laying. The first stands
/// upright, for comparison and for the seam.
pub const LEANS: [f64; 9] = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8];

/// Length of a sector's foot, bead widths: long enough that its middle is not held by the fins at its ends.
const FOOT: f64 = 10.0;

/// Chords to a sector: about one a bead.
const CHORDS: usize = 10;

/// Upright layers below, so that what is seen is not the grip of the bed.
const UPRIGHT: usize = 3;

/// Layers that lean: the last sectors are then some eight beads out, which no fin hides.
const LEANING: usize = 10;

pub(crate) fn fan(calibration: &Calibration) -> Result<Strand, CalibrateError> {
    strand(calibration, (0..UPRIGHT + LEANING).map(|layer| cycle(calibration.width, layer)))
}

/// Radius of the foot, bead widths.
pub(crate) fn foot_radius() -> f64 {
    FOOT * LEANS.len() as f64 / TAU
}

/// Where a sector ends on a layer, mm: its middle's direction, at its radius.
pub(crate) fn middle(width: f64, sector: usize) -> DVec2 {
    let angle = TAU * (sector as f64 + 0.5) / LEANS.len() as f64;
    DVec2::from_angle(angle) * radius(width, sector, UPRIGHT + LEANING - 1)
}

fn radius(width: f64, sector: usize, layer: usize) -> f64 {
    let leaning = (layer + 1).saturating_sub(UPRIGHT) as f64;
    width * (foot_radius() + LEANS[sector] * leaning)
}

/// The cycle of a layer about the origin, from the seam in the first sector on.
fn cycle(width: f64, layer: usize) -> Vec<DVec2> {
    let sector = TAU / LEANS.len() as f64;
    let seam = sector / 2.0 + seam_shift(layer) / foot_radius();
    let on = |k: usize, angle: f64| DVec2::from_angle(angle) * radius(width, k, layer);
    let mut cycle = vec![on(0, seam)];
    for k in 0..LEANS.len() {
        let chords = (0..=CHORDS).map(|chord| sector * (k as f64 + chord as f64 / CHORDS as f64));
        // Where the ring is still round, the end of one sector is the beginning of the next.
        let meets = k > 0 && radius(width, k, layer) == radius(width, k - 1, layer);
        cycle
            .extend(chords.skip(usize::from(meets)).filter(|&angle| k > 0 || angle > seam).map(|a| on(k, a)));
    }
    let last = LEANS.len() - 1;
    let meets = radius(width, last, layer) == radius(width, 0, layer);
    let chords = (0..CHORDS).map(|chord| sector * chord as f64 / CHORDS as f64);
    cycle.extend(chords.skip(usize::from(meets)).filter(|&angle| angle < seam).map(|a| on(0, a)));
    cycle
}
