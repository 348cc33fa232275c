//! Cycles above one another, as a strand.

use argil_strand::{DVec2, Move, Role, Strand, StrandLayer};

use crate::{CalibrateError, Calibration};

/// A strand of closed cycles about the origin, lowest first, moved to where the print stands. A cycle begins with its
/// seam and does not repeat it.
pub(crate) fn strand(
    calibration: &Calibration,
    cycles: impl IntoIterator<Item = Vec<DVec2>>,
) -> Result<Strand, CalibrateError> {
    let mut start = calibration.centre;
    let mut layers = Vec::new();
    for (index, cycle) in cycles.into_iter().enumerate() {
        let cycle: Vec<DVec2> = cycle.into_iter().map(|point| calibration.centre + point).collect();
        let seam = cycle.first().copied();
        let step = seam.filter(|_| index > 0).map(|to| Move { to, role: Role::Seam });
        if index == 0 {
            start = seam.unwrap_or(start);
        }
        let laid = cycle.into_iter().skip(1).chain(seam).map(|to| Move { to, role: Role::Wall });
        layers.push(StrandLayer {
            index,
            z: (index + 1) as f64 * calibration.layer_height,
            height: calibration.layer_height,
            width: calibration.width,
            moves: step.into_iter().chain(laid).collect(),
            supports: Vec::new(),
        });
    }
    Ok(Strand::new(start, layers)?)
}

/// Where the seam of a layer stands, in widths along its wall: to and fro, so that the step to the next layer is neither
/// a blob on one spot nor long.
pub(crate) fn seam_shift(layer: usize) -> f64 {
    if layer.is_multiple_of(2) { -0.5 } else { 0.5 }
}
