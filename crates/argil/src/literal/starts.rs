//! Section 3.3, last paragraph: each layer starts at a point of the layer below.

use argil_curve::{ClosedCurve, DVec2};
use argil_seam::{SeamError, nearest_chain};

use crate::Settings;
use crate::stages::Seam;

/// Every layer ends at its point nearest to the start of the layer above (section 3.3, the paragraph on moving from layer
/// to layer).
///
/// The text holds that a start "was present in the layer just below", by construction, and tells no rule to choose it. The
/// plainest that agrees is to go from the top down and take the nearest point each time. But a start may lie on a
/// bridge, over nothing: 23 of 120 on the bunny do, and steps are up to 1.6 mm long and may cross the layer. The costs by
/// which [`BestChain`](crate::stages::BestChain) looks for a place to hide the seam play no part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NearestStarts;

impl Seam for NearestStarts {
    fn starts(
        &mut self,
        cycles: &[ClosedCurve],
        _footholds: &[f64],
        _reach: f64,
        _settings: &Settings,
        _cost: &dyn Fn(usize, DVec2) -> f64,
    ) -> Result<Vec<f64>, SeamError> {
        Ok(nearest_chain(cycles))
    }
}
