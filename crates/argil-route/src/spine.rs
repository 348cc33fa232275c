//! Where a wall turns off to run along the middle of a thin part, there and back.

use argil_curve::{ClosedCurve, Segment, SegmentIndex};

/// Two lanes of one wall that are nearer than this, in w, are a spine.
const LANES: f64 = 0.06;

/// Stretches of a wall are two lanes if at least this much of it lies between them, in w. A spine's tip is shorter.
const TURN: f64 = 0.3;

/// For each wall the arcs where spines begin.
///
/// `all` has the segments of all walls in order.
///
/// # Complexity
/// Near linear in the vertices for loops that run along themselves in few places.
pub(crate) fn spine_roots(walls: &[ClosedCurve], all: &SegmentIndex, width: f64) -> Vec<Vec<f64>> {
    let mut first = 0;
    walls
        .iter()
        .map(|wall| {
            let count = wall.segment_count();
            let own = first..first + count;
            first = own.end;
            let mut doubled: Vec<bool> = (0..count)
                .map(|k| {
                    let (p, arc) = (wall.points()[k], wall.arc_of(k));
                    let mut found = false;
                    all.for_each_near(Segment::new(p, p), LANES * width, |index, segment| {
                        let near = segment.nearest(p);
                        if own.contains(&index) && near.point.distance(p) < LANES * width {
                            let there = wall.arc_of(index - own.start) + near.point.distance(segment.start);
                            found |= wall.arc_gap(arc, there) > TURN * width;
                        }
                    });
                    found
                })
                .collect();
            for k in 0..count {
                // The tip lies between two vertices that are both in the lanes.
                let around = [(k + count - 1) % count, (k + 1) % count];
                let [before, after] = around.map(|other| wall.arc_of(other));
                let is_tip = wall.arc_gap(before, after) < TURN * width;
                doubled[k] |= is_tip && around.iter().all(|&other| doubled[other]);
            }
            (0..count)
                .filter(|&k| doubled[k] && !(doubled[(k + count - 1) % count] && doubled[(k + 1) % count]))
                .map(|k| wall.arc_of(k))
                .collect()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use argil_curve::DVec2;

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
        let roots = spine_roots(&walls, &all, 1.5);
        let near = |arc: &f64| walls[0].point_at(*arc).distance(DVec2::new(10.0, 5.0)) < 0.1;
        assert!(roots[0].iter().filter(|arc| near(arc)).count() == 2, "{roots:?}");
    }
}
