//! A box with wider and wider windows.

use argil_strand::{DVec2, Strand};

use crate::layers::{seam_shift, strand};
use crate::{CalibrateError, Calibration};

/// Clear widths of the windows of [`Calibration::windows`], in bead widths: from left to right, the even ones along the
/// front, the odd ones along the back.
///
/// # Example
/// ```
/// use argil_calibrate::{Calibration, GAPS};
/// // The third lintel is straight, the next one hangs through.
/// let width = Calibration::default().width;
/// assert!((GAPS[2] * width - 2.4).abs() < 1e-9, "ε_along, mm");
/// ```
pub const GAPS: [f64; 10] = [1.0, 1.25, 1.6, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0];

/// Bead widths between the two sides of a pillar, from middle to middle, so that they do not merge.
const PILLAR: f64 = 3.0;

/// How far the strand turns inwards at a window, bead widths.
const DEPTH: f64 = 4.0;

/// Half of the box's depth, bead widths: what turns in from both sides stays four beads apart.
pub(crate) const HALF_DEPTH: f64 = 6.0;

/// Layers with windows.
const OPEN: usize = 4;

/// Layers above them: the lowest is the lintel that is looked at, the others show whether it bears.
const LINTEL: usize = 3;

pub(crate) fn windows(calibration: &Calibration) -> Result<Strand, CalibrateError> {
    strand(calibration, (0..OPEN + LINTEL).map(|layer| cycle(calibration.width, layer)))
}

/// Whether a window stands at the front.
pub(crate) fn is_in_front(window: usize) -> bool {
    window.is_multiple_of(2)
}

/// Half of the box's length, bead widths: the longer row of windows, with a pillar before, between and after.
pub(crate) fn half_length() -> f64 {
    let row = |front| {
        let widths = (0..GAPS.len()).filter(|&k| is_in_front(k) == front).map(|k| GAPS[k] + 1.0 + PILLAR);
        widths.sum::<f64>() + PILLAR
    };
    row(true).max(row(false)) / 2.0
}

/// The two edges of each window of a row, as places of the strand's middle in bead widths, from left to right.
pub(crate) fn edges(front: bool) -> Vec<[f64; 2]> {
    let mut at = -half_length();
    let row = (0..GAPS.len()).filter(|&window| is_in_front(window) == front);
    row.map(|window| {
        let left = at + PILLAR;
        at = left + GAPS[window] + 1.0;
        [left, at]
    })
    .collect()
}

/// The cycle of a layer about the origin, from the seam in the left side on: front, right side, back.
fn cycle(width: f64, layer: usize) -> Vec<DVec2> {
    let (x, y) = (half_length(), HALF_DEPTH);
    let row = |front: bool| {
        let outer = if front { -y } else { y };
        let inner = if front { DEPTH - y } else { y - DEPTH };
        let open = if layer < OPEN { edges(front) } else { Vec::new() };
        let turns = open
            .into_iter()
            .flat_map(move |[left, right]| [(left, outer), (left, inner), (right, inner), (right, outer)]);
        [(-x, outer)].into_iter().chain(turns).chain([(x, outer)]).collect::<Vec<_>>()
    };
    let seam = (-x, seam_shift(layer));
    let points = [seam].into_iter().chain(row(true)).chain(row(false).into_iter().rev());
    points.map(|(x, y)| DVec2::new(x, y) * width).collect()
}
