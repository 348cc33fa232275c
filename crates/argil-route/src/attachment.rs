//! Places on walls where strands leave and join them.

use argil_curve::{ClosedCurve, DVec2, on_grid};

use crate::spine::Spines;

/// Attachments of one layer: for every wall the arcs that are taken, so that no two come too close.
#[derive(Clone, Debug)]
pub(crate) struct Attachments {
    taken: Vec<Vec<f64>>,
    spines: Vec<Spines>,
    gap: f64,
    root_gap: f64,
    step: f64,
}

impl Attachments {
    /// Nothing taken yet; attachments keep `gap` from each other and, where possible, `root_gap` from the places
    /// where spines begin.
    pub(crate) fn new(spines: Vec<Spines>, gap: f64, root_gap: f64, step: f64) -> Self {
        Self { taken: vec![Vec::new(); spines.len()], spines, gap, root_gap, step }
    }

    /// Takes an arc of a wall.
    pub(crate) fn take(&mut self, wall: usize, arc: f64) {
        self.taken[wall].push(arc);
    }

    /// The arc nearest to `wanted` that keeps the gap to all taken ones; the one with most room, up to a quarter
    /// of a small wall, where there is no such place. `inside` tells that the strand lies inside of the loop, and `hops` that it
    /// comes from the other lane of a spine.
    pub(crate) fn free_near(
        &self,
        wall: usize,
        curve: &ClosedCurve,
        wanted: f64,
        (inside, hops): (bool, bool),
    ) -> f64 {
        let length = curve.length();
        let gap = self.gap.min(0.25 * length);
        let Spines { roots, lanes } = &self.spines[wall];
        // What lies between the lanes of a spine is solid, which is where a loop round solid has its inside.
        let in_solid = inside == (curve.signed_area() > 0.0);
        let after = |from: f64, to: f64| (to - from).rem_euclid(length);
        let is_in = |&[from, to]: &[f64; 2], arc: f64| after(from, arc) <= after(from, to);
        // Elsewhere the other side is that of another wall.
        let crossed = lanes.iter().find(|stretch| hops && is_in(stretch, wanted));
        let is_shut = |arc: f64| match crossed {
            Some(stretch) => !is_in(stretch, arc),
            None => in_solid && lanes.iter().any(|stretch| is_in(stretch, arc)),
        };
        let clear = |arc: f64| {
            if is_shut(arc) {
                return -1.0;
            }
            let room = self.taken[wall].iter().map(|&t| curve.arc_gap(arc, t)).fold(f64::INFINITY, f64::min);
            let from_root = roots.iter().map(|&t| curve.arc_gap(arc, t));
            from_root.map(|room| room * gap / self.root_gap).fold(room, f64::min)
        };
        // Beyond lanes that lead on to another part lies another room; beyond those of a dead end the same. What is wanted between lanes
        // has none.
        let leads_on = |stretch: &[f64; 2]| {
            let [from, to] = stretch.map(|arc| curve.point_at(arc));
            from.distance(to) > self.root_gap
        };
        let is_door =
            |arc: f64| in_solid && lanes.iter().any(|stretch| is_in(stretch, arc) && leads_on(stretch));
        let has_room = crossed.is_none() && !is_door(wanted);
        let tries = (0.5 * length / self.step).ceil().min(200.0) as usize;
        let mut best = (clear(wanted), wanted);
        let mut is_open = [true; 2];
        for k in 0..=tries {
            for (side, is_open) in [1.0, -1.0].into_iter().zip(&mut is_open) {
                let arc = (wanted + side * k as f64 * self.step).rem_euclid(length);
                *is_open &= !(has_room && is_door(arc));
                if !*is_open {
                    continue;
                }
                let room = clear(arc);
                if room >= gap {
                    return arc;
                }
                if room > best.0 {
                    best = (room, arc);
                }
            }
        }
        best.1
    }
}

/// A wall's loop with attachments inserted as vertices.
#[derive(Clone, Debug)]
pub(crate) struct AttachedLoop {
    /// Vertices of the loop, attachments included.
    pub(crate) points: Vec<DVec2>,
    /// Index of each attachment among the points, in the order given.
    pub(crate) at: Vec<usize>,
}

/// Inserts attachments at the given arcs. Each is rounded to the grid and pushed two grid steps towards
/// the side on which its strand lies, so that the triangulation there sees it as a convex corner of the
/// wall and not behind a sliver. Attachments that fall on a vertex, or on each other, share it.
///
/// `outside[k]` tells whether attachment k has its strand outside of the loop.
pub(crate) fn attach(curve: &ClosedCurve, arcs: &[f64], outside: &[bool], grid: f64) -> AttachedLoop {
    let merge = 40.0 * grid;
    let ccw = curve.signed_area() > 0.0;
    let mut order: Vec<usize> = (0..arcs.len()).collect();
    order.sort_by(|&a, &b| arcs[a].total_cmp(&arcs[b]).then(a.cmp(&b)));
    let mut points = Vec::with_capacity(curve.segment_count() + arcs.len());
    let mut at = vec![0; arcs.len()];
    let mut next = order.into_iter().peekable();
    for segment in 0..curve.segment_count() {
        let line = curve.segment(segment);
        let begin = curve.arc_of(segment);
        let end = begin + line.length();
        points.push(line.start);
        while let Some(&k) = next.peek() {
            if arcs[k] >= end && segment + 1 < curve.segment_count() {
                break;
            }
            next.next();
            let along = (arcs[k] - begin).clamp(0.0, line.length());
            let direction = (line.end - line.start).normalize_or_zero();
            let last = points[points.len() - 1];
            let right = DVec2::new(direction.y, -direction.x);
            let outward = if ccw { right } else { -right };
            let push = if outside[k] { outward } else { -outward };
            let place = line.start + along * direction;
            if last.distance(place) <= merge {
                at[k] = points.len() - 1;
            } else if line.end.distance(place) <= merge {
                // The end is the next vertex: the first of the loop after the last segment.
                at[k] = if segment + 1 == curve.segment_count() { 0 } else { points.len() };
            } else {
                at[k] = points.len();
                points.push(on_grid(place + 2.0 * grid * push, grid));
            }
        }
    }
    AttachedLoop { points, at }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> ClosedCurve {
        let corners = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)];
        ClosedCurve::new(corners.iter().map(|&(x, y)| DVec2::new(x, y)).collect()).unwrap()
    }

    #[test]
    fn attachments_stand_in_order_and_lean_to_their_side() {
        let loops = attach(&square(), &[25.0, 5.0, 10.0], &[true, false, true], 1e-4);
        assert_eq!(loops.points.len(), 6);
        assert_eq!(loops.points[loops.at[2]], DVec2::new(10.0, 0.0), "on a corner: the corner itself");
        assert!(loops.points[loops.at[1]].y > 0.0, "inside");
        assert!(loops.points[loops.at[0]].y > 10.0, "outside");
    }

    #[test]
    fn a_taken_place_is_kept_clear_of() {
        let curve = square();
        let mut attachments = Attachments::new(vec![Spines::default()], 2.5, 0.7, 0.5);
        attachments.take(0, 5.0);
        let arc = attachments.free_near(0, &curve, 5.2, (true, false));
        assert!(curve.arc_gap(arc, 5.0) >= 2.5);
        assert!(curve.arc_gap(arc, 5.2) <= 3.5);
    }

    #[test]
    fn the_root_of_a_spine_is_kept_clear_of() {
        let curve = square();
        let attachments =
            Attachments::new(vec![Spines { roots: vec![5.0], ..Spines::default() }], 2.5, 0.7, 0.1);
        let gap = curve.arc_gap(attachments.free_near(0, &curve, 5.2, (true, false)), 5.0);
        assert!((0.7..0.9).contains(&gap));
    }

    #[test]
    fn between_the_lanes_of_a_spine_there_is_no_room() {
        let curve = square();
        let spine = Spines { roots: vec![4.0, 8.0], lanes: vec![[4.0, 8.0]] };
        let attachments = Attachments::new(vec![spine], 2.5, 0.7, 0.1);
        assert!(
            !(4.0..=8.0).contains(&attachments.free_near(0, &curve, 6.0, (true, false))),
            "inside is shut"
        );
        assert!(
            (4.0..=8.0).contains(&attachments.free_near(0, &curve, 6.0, (false, false))),
            "outside is not"
        );
    }

    #[test]
    fn a_hop_stays_between_the_lanes() {
        let curve = square();
        let spine = Spines { roots: vec![4.0, 8.0], lanes: vec![[4.0, 8.0]] };
        let mut attachments = Attachments::new(vec![spine], 2.5, 0.7, 0.1);
        attachments.take(0, 4.5);
        let arc = attachments.free_near(0, &curve, 4.6, (true, true));
        assert!(arc > 4.6 && (4.0..=8.0).contains(&arc), "apart from what is taken: {arc}");
    }

    #[test]
    fn beyond_lanes_that_lead_on_lies_another_room() {
        let curve = square();
        let spine = Spines { roots: vec![4.0, 8.0], lanes: vec![[4.0, 8.0]] };
        let mut attachments = Attachments::new(vec![spine], 2.5, 0.7, 0.1);
        attachments.take(0, 2.0);
        let arc = attachments.free_near(0, &curve, 3.9, (true, false));
        assert!(!(2.0..=8.0).contains(&arc), "back past what is taken, not through the lanes: {arc}");
        assert!(curve.arc_gap(arc, 2.0) >= 2.5);
    }

    #[test]
    fn a_tiny_wall_still_gets_a_place() {
        let corners = [(0.0, 0.0), (0.5, 0.0), (0.5, 0.5)];
        let curve = ClosedCurve::new(corners.iter().map(|&(x, y)| DVec2::new(x, y)).collect()).unwrap();
        let mut attachments = Attachments::new(vec![Spines::default()], 2.5, 0.7, 0.5);
        attachments.take(0, 0.0);
        let arc = attachments.free_near(0, &curve, 0.0, (true, false));
        assert!(curve.arc_gap(arc, 0.0) > 0.2);
    }
}
