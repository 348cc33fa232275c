//! A place on every layer where the layer above may begin.
//!
//! The strand climbs by short steps, and each layer has to begin where the layer below holds it. Where strand ends on a
//! wall, or a body begins in mid-air over a thread of support, no such chain need exist by itself. So while the layers
//! are planned from the top down, one start a layer is chosen in sight of the walls below, and the next layer is
//! asked to hold it. On walls that stand on walls this costs nothing. The seam stage is free to find a better chain; where it
//! finds none on its own spacing, this one serves.

use argil_curve::{ClosedCurve, DVec2, Segment, SegmentIndex};
use argil_seam::SeamSettings;
use argil_support::{Placement, SupportPoint};

/// Share of the longest step that is used, so that starts on the seam stage's own spacing reach each other too.
const STEP: f64 = 0.85;

/// Share of `ε_across` within which a wall must pass, for the same reason.
const HELD: f64 = 0.65;

/// A start, and whether the walls below hold it and lead up to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Foothold {
    pub(crate) at: DVec2,
    pub(crate) over_wall: bool,
}

/// The start on a planned cycle: within a step of the start above, over the walls below where one is, else as near
/// to them as can be had, so that the starts make for the walls. `above` is the cycle above with its start; the step
/// up to it must cross nothing there.
///
/// A wall that lies near but on the far side of a strand of this cycle is no help: under a dome every wall lies outside
/// of the one above, and what stands inside can be reached from inside only.
pub(crate) fn foothold(
    cycle: &ClosedCurve,
    above: Option<(&ClosedCurve, DVec2)>,
    walls_below: &SegmentIndex,
    seam: &SeamSettings,
) -> Foothold {
    let count = (cycle.length() / seam.spacing).ceil().clamp(4.0, 1e6) as usize;
    let places = (0..count).map(|k| cycle.point_at(k as f64 * cycle.length() / count as f64));
    let nearest = above.map(|(_, start)| cycle.nearest(start).point);
    places
        .chain(nearest)
        .filter(|&place| above.is_none_or(|(next, start)| reaches(place, start, next, STEP * seam.reach)))
        .map(|place| {
            let wall = walls_below.nearest(place);
            let led = wall.is_some_and(|wall| reaches(wall.point, place, cycle, f64::INFINITY));
            let hanging = wall.map_or(f64::INFINITY, |wall| (wall.distance - HELD * seam.across).max(0.0));
            let over_wall = led && hanging <= 0.0;
            // Inside a dome the way to a wall is longer than it looks.
            let far = if led { hanging } else { hanging + seam.reach };
            (far, above.map_or(0.0, |(_, start)| start.distance(place)), Foothold { at: place, over_wall })
        })
        .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)))
        .map(|(_, _, foothold)| foothold)
        .unwrap_or(Foothold { at: nearest.unwrap_or(cycle.points()[0]), over_wall: false })
}

/// Whether a step up to a cycle is short enough and crosses none of its strands.
fn reaches(from: DVec2, to: DVec2, cycle: &ClosedCurve, reach: f64) -> bool {
    // The step ends on a strand of the cycle: it is tested without its last thousandth, or rounding would make it cross
    // the very strand that it ends on.
    let step = Segment::new(from, to.lerp(from, 1e-3));
    from.distance(to) <= reach && !cycle.segments().any(|strand| strand.crosses(&step))
}

/// Sees to it that the start above is held: by a wall, by a point that is asked for anyway, or by one more.
pub(crate) fn hold_start(start: Foothold, supports: &mut Vec<SupportPoint>, placement: &Placement) {
    let held_by_point =
        |s: &SupportPoint| s.needs.iter().any(|need| need.distance(start.at) <= placement.cover);
    if !start.over_wall && !supports.iter().any(held_by_point) {
        supports.push(SupportPoint { position: start.at, needs: vec![start.at] });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(radius: f64) -> ClosedCurve {
        let points = (0..48).map(|k| radius * DVec2::from_angle(f64::from(k) * std::f64::consts::TAU / 48.0));
        ClosedCurve::new(points.collect()).unwrap()
    }

    #[test]
    fn starts_make_for_the_wall_below() {
        let seam = SeamSettings::for_width(1.5);
        let walls = SegmentIndex::of_curves([&ring(10.0)], 1.5);
        // A strand that runs out to the wall on the right, now a little higher, now a little lower.
        let strand = |layer: i32| {
            let lift = 0.07 * f64::from(layer % 2);
            let points = [(4.0, lift), (10.0, 0.2 + lift), (10.0, lift - 0.2)];
            ClosedCurve::new(points.map(|(x, y)| DVec2::new(x, y)).to_vec()).unwrap()
        };
        let mut start = DVec2::new(4.0, 0.0);
        for layer in 1..10 {
            let next = foothold(&strand(layer), Some((&strand(layer - 1), start)), &walls, &seam).at;
            assert!(next.distance(start) <= seam.reach);
            start = next;
        }
        assert!(walls.distance(start) <= seam.across, "{start} has reached the wall");
    }

    #[test]
    fn a_start_over_nothing_is_asked_for_once() {
        let placement = Placement::for_width(1.5);
        let mut supports = Vec::new();
        hold_start(Foothold { at: DVec2::ONE, over_wall: true }, &mut supports, &placement);
        assert!(supports.is_empty(), "the wall holds it");
        hold_start(Foothold { at: DVec2::ZERO, over_wall: false }, &mut supports, &placement);
        hold_start(Foothold { at: DVec2::new(0.1, 0.0), over_wall: false }, &mut supports, &placement);
        assert_eq!(supports.len(), 1);
    }

    #[test]
    fn a_wall_behind_a_strand_does_not_lead_up() {
        let seam = SeamSettings::for_width(1.5);
        // A ring with an excursion inwards, over a wall that is a little wider than the ring.
        let mut points: Vec<DVec2> = ring(10.0).points().to_vec();
        points
            .splice(0..1, [(10.0, 0.0), (8.0, 0.3), (8.0, -0.3), (10.0, 0.0)].map(|(x, y)| DVec2::new(x, y)));
        let cycle = ClosedCurve::new(points).unwrap();
        let walls = SegmentIndex::of_curves([&ring(10.2)], 1.5);
        let inside = DVec2::new(7.0, 0.0);
        let tip = foothold(&cycle, Some((&ring(7.0), inside)), &walls, &seam);
        assert!(tip.at.length() < 9.9 && !tip.over_wall, "{tip:?}");
    }
}
