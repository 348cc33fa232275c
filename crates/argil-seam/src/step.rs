//! Which steps from layer to layer are allowed.

use argil_curve::{ClosedCurve, DVec2, Segment, SegmentIndex};

/// A step and a strand nearer than this touch, mm: twice the grid of the printed output, so that rounding
/// both to the grid cannot make them cross.
const TOUCH: f64 = 2e-4;

/// A point this near a segment lies on it, mm; only rounding parts them.
const ON_STRAND: f64 = 1e-9;

/// The arc may be longer than the straight way by this and still count as running straight along it, mm.
const STRAIGHT: f64 = 1e-3;

/// Cosine of the turn from which on it is sharp, 130°: a little less than the 135° that prints are measured by.
const SHARP: f64 = -0.642_787_609_686_539_3;

/// A step shorter than this has no direction, mm: both its ends are one point of the printed output.
const NO_STEP: f64 = 1e-4;

/// How many sharp turns a step brings, for a walk that comes to it in one direction and leaves it in another (unit
/// vectors).
pub(crate) fn sharp_turns(arriving: DVec2, step: DVec2, leaving: DVec2) -> u8 {
    let length = step.length();
    if length < NO_STEP {
        return u8::from(arriving.dot(leaving) < SHARP);
    }
    u8::from(arriving.dot(step) < SHARP * length) + u8::from(step.dot(leaving) < SHARP * length)
}

/// Whether the step that ends on `cycle` at arc length `s` is clear of every segment of the cycle: it touches it nowhere but at its
/// own end, or where it runs straight along the strand that it ends on.
///
/// # Complexity
/// O(n) for n segments.
///
/// # Example
/// ```
/// use argil_seam::{ClosedCurve, DVec2, Segment, is_clear};
/// let square = [(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)].map(DVec2::from).to_vec();
/// let cycle = ClosedCurve::new(square)?;
/// let end = DVec2::new(4.0, 0.0); // at arc length 4
/// assert!(is_clear(&Segment::new(DVec2::new(4.0, -1.0), end), 4.0, &cycle));
/// assert!(!is_clear(&Segment::new(DVec2::new(4.0, 12.0), end), 4.0, &cycle)); // through the upper side
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn is_clear(step: &Segment, s: f64, cycle: &ClosedCurve) -> bool {
    let low = step.start.min(step.end) - TOUCH;
    let high = step.start.max(step.end) + TOUCH;
    step.length() <= ON_STRAND
        || !cycle
            .segments()
            .enumerate()
            .any(|(k, strand)| !is_beside(&strand, low, high) && blocks(step, s, cycle, k, &strand))
}

/// From how many of `directions`, evenly spread, no clear step of length `reach` ends on `cycle` at arc length `s`.
///
/// # Complexity
/// O(n + directions k) for n segments, of which k lie within `reach`.
///
/// # Example
/// ```
/// use argil_seam::{ClosedCurve, DVec2, shut_directions};
/// let square = [(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)].map(DVec2::from).to_vec();
/// let cycle = ClosedCurve::new(square)?;
/// assert_eq!(shut_directions(&cycle, 4.0, 0.5, 16), 0); // nothing else is near
/// assert!(shut_directions(&cycle, 4.0, 10.0, 16) > 0); // from beyond the upper side
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn shut_directions(cycle: &ClosedCurve, s: f64, reach: f64, directions: usize) -> usize {
    let end = cycle.point_at(s);
    let (low, high) = (end - reach - TOUCH, end + reach + TOUCH);
    let near: Vec<(usize, Segment)> =
        cycle.segments().enumerate().filter(|(_, strand)| !is_beside(strand, low, high)).collect();
    let is_shut = |k: &usize| {
        let turn = std::f64::consts::TAU * *k as f64 / directions as f64;
        let step = Segment::new(end + reach * DVec2::from_angle(turn), end);
        step.length() > ON_STRAND && near.iter().any(|(k, strand)| blocks(&step, s, cycle, *k, strand))
    };
    (0..directions).filter(is_shut).count()
}

/// Whether a segment lies beside a box.
fn is_beside(strand: &Segment, low: DVec2, high: DVec2) -> bool {
    strand.start.min(strand.end).cmpgt(high).any() || strand.start.max(strand.end).cmplt(low).any()
}

/// [`is_clear`] by an index over the segments of `cycle`, in order.
pub(crate) fn is_clear_by(index: &SegmentIndex, step: &Segment, s: f64, cycle: &ClosedCurve) -> bool {
    let mut clear = true;
    if step.length() > ON_STRAND {
        index.for_each_near(*step, TOUCH, |k, strand| clear = clear && !blocks(step, s, cycle, k, &strand));
    }
    clear
}

/// Whether segment `k` of the cycle is in the way of the step. A step may touch the cycle at its own end, and
/// it may run along the strand that it ends on; it may neither cross nor touch it elsewhere.
fn blocks(step: &Segment, s: f64, cycle: &ClosedCurve, k: usize, strand: &Segment) -> bool {
    let end = cycle.on_segment(k, step.end);
    if end.distance <= ON_STRAND {
        return cycle.arc_gap(end.s, s) > STRAIGHT;
    }
    if step.crosses(strand) {
        return true;
    }
    let touching = [strand.start, strand.end]
        .map(|p| (step.distance(p), p))
        .into_iter()
        .chain([step.start, step.end].map(|p| (strand.distance(p), strand.nearest(p).point)))
        .reduce(|a, b| if b.0 < a.0 { b } else { a });
    touching.is_some_and(|(distance, contact)| {
        let along = cycle.arc_gap(cycle.on_segment(k, contact).s, s);
        distance <= TOUCH && along > contact.distance(step.end) + STRAIGHT
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clear(from: (f64, f64), s: f64) -> bool {
        // A hairpin 1 mm wide: out along y = 0, back along y = 1.
        let points = [(0.0, 0.0), (10.0, 0.0), (10.0, 1.0), (0.0, 1.0)].map(DVec2::from);
        let cycle = ClosedCurve::new(points.to_vec()).unwrap();
        let step = Segment::new(from.into(), cycle.point_at(s));
        let index = SegmentIndex::of_curves([&cycle], 1.0);
        let answer = is_clear(&step, s, &cycle);
        assert_eq!(answer, is_clear_by(&index, &step, s, &cycle));
        answer
    }

    #[test]
    fn a_step_back_turns_twice() {
        let turns = |step| sharp_turns(DVec2::X, step, DVec2::X);
        assert_eq!((turns(DVec2::X), turns(DVec2::Y), turns(-DVec2::X), turns(DVec2::ZERO)), (0, 0, 2, 0));
        assert_eq!(sharp_turns(DVec2::X, DVec2::ZERO, -DVec2::X), 1);
    }

    #[test]
    fn a_step_touches_only_where_it_ends() {
        assert!(clear((5.0, -0.5), 5.0), "from outside");
        assert!(clear((5.0, 0.5), 5.0), "from inside");
        assert!(!clear((5.0, 1.5), 5.0), "across the other strand");
        assert!(!clear((5.0, 1.0), 5.0), "from the other strand");
        assert!(!clear((10.5, -0.5), 12.0), "through the corner to the other strand");
    }

    #[test]
    fn a_step_may_run_along_its_own_strand() {
        assert!(clear((4.5, 0.0), 5.0) && clear((5.5, 0.0), 5.0));
        assert!(clear((10.5, 0.0), 9.9), "over a corner, in line with the strand");
        assert!(!clear((9.5, 0.0), 10.5), "from before the corner to behind it");
        assert!(clear((5.0, 0.0), 5.0));
    }
}
