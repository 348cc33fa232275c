//! Support points at a fixed stride, as the paper's text has it.

use crate::coverage::Coverage;
use crate::{Criterion, SupportPoint};
use argil_curve::{ClosedCurve, SegmentIndex, held_spans};

/// Strides never come closer than this share of the curve's length; see the same limit in the placement.
const SHORTEST_STRIDE: f64 = 1e-6;

/// Support points by the letter of Sec. 3.2 and Eq. 1 of the paper, for comparison.
///
/// The curve is walked at a stride of `ε_along`. A sample is held when some contact lies less than half of
/// `ε_along` away along the arc, a contact being a point of the curve within `ε_across` of a wall or of a
/// support point already placed; a sample that is not held becomes a support point. Contacts are found
/// exactly here, where an implementation would sample.
///
/// Not to be printed from: two neighbouring samples may lean on contacts on their far sides, so stretches of
/// up to twice `ε_along` hang although every sample is held. [`place_supports`](crate::place_supports) leaves
/// none. A stride that is not positive, or a limit that is not finite, places nothing.
///
/// # Complexity
/// O(n log n) for evenly spread curves.
///
/// # Example
/// ```
/// use argil_support::{ClosedCurve, Criterion, DVec2, SegmentIndex, stride_supports};
/// let line = ClosedCurve::new(vec![DVec2::ZERO, DVec2::new(6.0, 0.0)])?;
/// let nothing = SegmentIndex::new(Vec::new(), 1.0);
/// let points = stride_supports(&line, &nothing, &Criterion { across: 0.5, along: 2.0 });
/// // On the way back the strand lies over the points of the way there.
/// assert_eq!(points.len(), 4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn stride_supports(
    above: &ClosedCurve,
    walls: &SegmentIndex,
    criterion: &Criterion,
) -> Vec<SupportPoint> {
    let usable = criterion.along > 0.0 && criterion.along.is_finite() && criterion.across.is_finite();
    if !usable {
        return Vec::new();
    }
    let length = above.length();
    let stride = criterion.along.max(SHORTEST_STRIDE * length);
    let cell = (length / above.segment_count() as f64).max(criterion.across);
    let index = SegmentIndex::of_curves([above], cell);
    let mut contacts = Coverage::new(above, &index, &held_spans(above, walls, criterion.across));
    let mut points = Vec::new();
    for k in 0..(length / stride).ceil() as usize {
        let s = k as f64 * stride;
        // On a curve shorter than the stride half of it either way is all of it.
        let lean = (stride / 2.0).min(length / 2.0);
        if !contacts.meets(s - lean, s + lean) {
            let position = above.point_at(s);
            contacts.hold_about(position, criterion.across.max(0.0), 0.0);
            contacts.hold(s, s);
            points.push(SupportPoint { position, needs: vec![position] });
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Placement, place_supports, unsupported_spans};
    use argil_curve::{DVec2, Segment};

    /// Two samples held by contacts on their far sides leave nearly two strides hanging.
    #[test]
    fn the_stride_passes_gaps_that_the_criterion_does_not() {
        let criterion = Criterion { across: 0.1, along: 2.0 };
        let ring =
            ClosedCurve::new([(0.0, 0.0), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0)].map(DVec2::from).to_vec())
                .unwrap();
        // Wall everywhere but from x = 1.1 to x = 4.9 on the lower side; samples stand at 2 and at 4.
        let walls = [(4.9, 0.0), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0), (0.0, 0.0), (1.1, 0.0)].map(DVec2::from);
        let walls: Vec<Segment> = walls.windows(2).map(|e| Segment::new(e[0], e[1])).collect();
        let index = SegmentIndex::new(walls, 1.0);
        assert!(stride_supports(&ring, &index, &criterion).is_empty());
        let hanging = unsupported_spans(&ring, &index, &criterion);
        assert_eq!(hanging.len(), 1);
        assert!((hanging[0].length - 3.6).abs() < 1e-9);
        let placement = Placement::for_criterion(1.0, &criterion);
        assert_eq!(place_supports(&ring, &index, &placement).len(), 1);
    }
}
