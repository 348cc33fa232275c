//! Where a wall turns off to run along the middle of a thin part, there and back, or beside the wall of the hole beyond.

use argil_curve::{ClosedCurve, DVec2, Segment, SegmentIndex};

/// Two lanes that are nearer than this, in w, are a spine.
pub(crate) const LANES: f64 = 0.06;

/// Stretches of a wall are two lanes if at least this much of it lies between them, in w. A spine's tip is shorter.
const TURN: f64 = 0.3;

/// The spines of one wall.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Spines {
    /// Arcs where the wall turns off into a spine. A strand that came from inside there would seem to pass through the wall.
    pub(crate) roots: Vec<f64>,
    /// The stretches between them, from arc to arc. Between the two lanes of one there is room for a hop across, where they are those of two
    /// walls, and for no other strand.
    pub(crate) lanes: Vec<[f64; 2]>,
}

/// The spines of each wall.
///
/// `all` has the segments of all walls in order.
///
/// # Complexity
/// Near linear in the vertices for loops that run along themselves in few places.
pub(crate) fn spines(walls: &[ClosedCurve], all: &SegmentIndex, width: f64) -> Vec<Spines> {
    let mut first = 0;
    walls
        .iter()
        .map(|wall| {
            let count = wall.segment_count();
            let own = first..first + count;
            first = own.end;
            let is_doubled = |p: DVec2, arc: f64| {
                let mut found = false;
                all.for_each_near(Segment::new(p, p), LANES * width, |index, segment| {
                    let near = segment.nearest(p);
                    if near.point.distance(p) < LANES * width {
                        // Between two holes the lanes are those of two walls.
                        found |= !own.contains(&index) || {
                            let there = wall.arc_of(index - own.start) + near.point.distance(segment.start);
                            wall.arc_gap(arc, there) > TURN * width
                        };
                    }
                });
                found
            };
            Spines {
                roots: roots(wall, &is_doubled, TURN * width),
                lanes: lanes(wall, &is_doubled, TURN * width),
            }
        })
        .collect()
}

/// The vertices where a wall runs along itself on one side only. `is_doubled` tells whether it does at a place, given with its arc.
fn roots(wall: &ClosedCurve, is_doubled: &impl Fn(DVec2, f64) -> bool, turn: f64) -> Vec<f64> {
    let count = wall.segment_count();
    let mut doubled: Vec<bool> = (0..count).map(|k| is_doubled(wall.points()[k], wall.arc_of(k))).collect();
    for k in 0..count {
        // The tip lies between two vertices that are both in the lanes.
        let around = [(k + count - 1) % count, (k + 1) % count];
        let [before, after] = around.map(|other| wall.arc_of(other));
        let is_tip = wall.arc_gap(before, after) < turn;
        doubled[k] |= is_tip && around.iter().all(|&other| doubled[other]);
    }
    (0..count)
        .filter(|&k| doubled[k] && !(doubled[(k + count - 1) % count] && doubled[(k + 1) % count]))
        .map(|k| wall.arc_of(k))
        .collect()
}

/// The runs of sides in the middle of which a wall runs along itself, with the tips between them.
fn lanes(wall: &ClosedCurve, is_doubled: &impl Fn(DVec2, f64) -> bool, turn: f64) -> Vec<[f64; 2]> {
    let count = wall.segment_count();
    let sides = (0..count).map(|k| (wall.arc_of(k), wall.segment(k)));
    let doubled = sides.filter(|&(arc, side)| is_doubled(side.point_at(0.5), arc + 0.5 * side.length()));
    let mut lanes: Vec<[f64; 2]> = Vec::new();
    for (arc, side) in doubled {
        match lanes.last_mut() {
            Some(last) if arc - last[1] < turn => last[1] = arc + side.length(),
            _ => lanes.push([arc, arc + side.length()]),
        }
    }
    // The last may go on over the first point of the loop.
    if let [first, .., last] = lanes[..]
        && first[0] + wall.length() - last[1] < turn
    {
        lanes.pop();
        lanes[0][0] = last[0];
    }
    lanes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spine_begins_where_its_lanes_part() {
        let points = [
            (0.0, 0.0),
            (10.0, 0.0),
            (10.0, 4.97),
            (16.0, 4.97),
            (16.0, 5.03),
            (10.0, 5.03),
            (10.0, 10.0),
            (0.0, 10.0),
        ];
        let wall = ClosedCurve::new(points.iter().map(|&p| DVec2::from(p)).collect()).unwrap();
        let walls = [wall];
        let all = SegmentIndex::of_curves(&walls, 1.5);
        let found = &spines(&walls, &all, 1.5)[0];
        let near = |arc: &f64| walls[0].point_at(*arc).distance(DVec2::new(10.0, 5.0)) < 0.1;
        assert!(found.roots.iter().filter(|arc| near(arc)).count() == 2, "{found:?}");
        let [[from, to]] = found.lanes[..] else { panic!("one spine: {found:?}") };
        assert!(near(&from) && near(&to) && (to - from - 12.06).abs() < 1e-9, "there and back: {found:?}");
    }
}
