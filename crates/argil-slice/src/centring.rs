//! From a chordal axis to the medial axis.
//!
//! A chord that runs slantwise across a strip has its middle beside the strip's middle line, and a triangle where a branch was cut away still more. Where
//! the strip is hardly wider than a bead, what of the wall has room there is as narrow as that.

use argil_curve::{Segment, SegmentIndex};
use glam::DVec2;

/// Nodes farther than this from the boundary, in w, lie inside the wall: they stay.
const DEEP: f64 = 0.6;

/// Rounds, and how near to the middle is near enough, in w.
const ROUNDS: usize = 3;
const CENTRED: f64 = 0.002;

/// The boundary counts as the other side within this angle of straight across, as its cosine: 60°.
const ACROSS: f64 = 0.5;

/// The place where both sides of what is at most a little wider than a bead are equally far, from one near it.
///
/// # Complexity
/// O(k) for k sides of the boundary within a bead.
pub(crate) fn centred(mut at: DVec2, boundary: &SegmentIndex, width: f64) -> DVec2 {
    for _ in 0..ROUNDS {
        let Some(step) = step_to_middle(at, boundary, width) else { break };
        at += step;
        if step.length() < CENTRED * width {
            break;
        }
    }
    at
}

/// From a place half the difference of its distances from both sides, away from the nearer; `None` where there is no other side near.
fn step_to_middle(at: DVec2, boundary: &SegmentIndex, width: f64) -> Option<DVec2> {
    let near = boundary.nearest_within(at, DEEP * width).filter(|near| near.distance > 0.0)?;
    let away = (at - near.point) / near.distance;
    let mut far = f64::INFINITY;
    boundary.for_each_near(Segment::new(at, at), width, |_, side| {
        let point = side.nearest(at).point;
        let distance = point.distance(at);
        if (point - at).dot(away) > ACROSS * distance {
            far = far.min(distance);
        }
    });
    (far <= width).then(|| 0.5 * (far - near.distance) * away)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_get_to_the_middle_of_a_strip() {
        let line = |y: f64, from: f64, to: f64| Segment::new(DVec2::new(from, y), DVec2::new(to, y));
        let boundary = SegmentIndex::new(vec![line(0.0, -5.0, 5.0), line(1.4, 5.0, -5.0)], 1.5);
        for y in [0.4, 0.69, 0.95] {
            let at = centred(DVec2::new(1.0, y), &boundary, 1.5);
            assert!(at.x == 1.0 && (at.y - 0.7).abs() < 0.004, "{at}");
        }
        let beyond = DVec2::new(1.0, 3.0);
        assert_eq!(centred(beyond, &boundary, 1.5), beyond, "no strip is there");
    }
}
