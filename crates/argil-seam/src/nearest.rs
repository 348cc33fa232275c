//! The plainest start rule that the text of the paper allows.

use argil_curve::ClosedCurve;

/// For each cycle (bottom first) the arc length of its start by the greedy rule: the topmost starts at its
/// vertex 0, each one below at its point nearest to the start above.
///
/// The paper asks for a start that the layer below contains (Sec. 3.3); this is the plainest reading. The rule looks
/// at one pair of layers at a time, so it walks into places that nothing holds (23 of 120 starts on a test
/// model), takes steps as long as they come out, and lets them cross the cycle. It is here to be compared with
/// [`seam_chain`](crate::seam_chain).
///
/// # Complexity
/// O(n) for n segments in all.
///
/// # Example
/// ```
/// use argil_seam::{ClosedCurve, DVec2, nearest_chain};
/// let bar = |y: f64| ClosedCurve::new(vec![DVec2::new(0.0, y), DVec2::new(4.0, y)]);
/// assert_eq!(nearest_chain(&[bar(0.5)?, bar(0.0)?]), [0.0, 0.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn nearest_chain(cycles: &[ClosedCurve]) -> Vec<f64> {
    let mut starts = vec![0.0; cycles.len()];
    for k in (1..cycles.len()).rev() {
        let above = cycles[k].point_at(starts[k]);
        starts[k - 1] = cycles[k - 1].nearest(above).s;
    }
    starts
}
