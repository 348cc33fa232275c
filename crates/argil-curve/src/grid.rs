//! The grid of the printed output.

use glam::DVec2;

/// The nearest place on a grid of that step, mm. A step that is not above zero is no grid, and the place stays.
///
/// Each coordinate is the double that is nearest to a whole number of steps divided by steps per mm: for steps of 1, 0.1, … 0.0001 mm what a
/// reader makes of the decimals that are printed. A product with the step would differ from that in its last bit, and
/// with it what crosses by the one and touches by the other.
///
/// # Example
/// ```
/// use argil_curve::{DVec2, on_grid};
/// let place = on_grid(DVec2::new(12.900_72, -0.437_96), 1e-4);
/// assert_eq!(place, DVec2::new("12.9007".parse().unwrap(), "-0.4380".parse().unwrap()));
/// assert_eq!(on_grid(place, 1e-4), place);
/// ```
#[must_use]
pub fn on_grid(p: DVec2, grid: f64) -> DVec2 {
    if grid > 0.0 {
        let steps = 1.0 / grid;
        (p * steps).round() / steps
    } else {
        p
    }
}
