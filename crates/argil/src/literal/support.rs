//! Section 3.2: samples at a stride.

use argil_curve::{ClosedCurve, SegmentIndex};
use argil_support::{SupportPoint, stride_supports};

use crate::Settings;
use crate::stages::Support;

/// Support points at a stride of `ε_along`, wherever Eq. 1 finds no contact within half of it (section 3.2).
///
/// The criterion is taken whole, with nothing in hand for what comes after: the text has no margin. Where a cycle is
/// begun to be walked is not said; here it is its first vertex.
///
/// Two samples may lean on contacts on their far sides, so that nearly two strides hang although each sample is held.
/// 129 spans of the bunny hang like that before any smoothing. [`FewestPoints`](crate::stages::FewestPoints) measures
/// along the whole curve instead of at samples.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StrideSupport;

impl Support for StrideSupport {
    fn points(
        &mut self,
        above: &ClosedCurve,
        walls: &SegmentIndex,
        settings: &Settings,
    ) -> Vec<SupportPoint> {
        stride_supports(above, walls, &settings.criterion())
    }
}
