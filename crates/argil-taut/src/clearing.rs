//! What a moving point must not do to walls and to other strands.

use argil_curve::{DVec2, Segment, SegmentIndex};

/// Least distance of a point from a wall near its own root, as a share of the distance that is kept elsewhere.
const TOUCH: f64 = 0.15;

/// The walls and the free edges as they were when the sweep began.
pub(crate) struct Clearing<'a> {
    pub(crate) walls: &'a SegmentIndex,
    /// Free edges of the path as they were when the sweep began.
    pub(crate) edges: &'a SegmentIndex,
    /// Which edge of the path each of them is.
    pub(crate) edge_of: &'a [u32],
    /// Arc length from the path's first point to each, and its whole length, as they were when the sweep began, mm.
    pub(crate) arcs: &'a [f64],
    pub(crate) length: f64,
    /// Strands nearer than this along the path only must not cross, mm.
    pub(crate) turn: f64,
    /// What strands keep from each other, mm.
    pub(crate) apart: f64,
    /// What strands keep from walls, mm.
    pub(crate) off: f64,
    /// How far an edge may have moved since the sweep began, mm.
    pub(crate) moved: f64,
}

/// What lies round one point of the path: enough for every question about a move of it.
#[derive(Debug, Default)]
pub(crate) struct Surroundings {
    /// Walls with their index.
    walls: Vec<(usize, Segment)>,
    /// Free edges of the path, named by their first points.
    strands: Vec<usize>,
}

impl Surroundings {
    /// The wall nearest to a point within a distance, with the distance and the point on it; the one of the lowest index among equals.
    fn nearest_wall(&self, p: DVec2, within: f64) -> Option<(f64, DVec2)> {
        let mut best: Option<(f64, usize, DVec2)> = None;
        for &(index, wall) in &self.walls {
            let near = wall.nearest(p);
            let is_nearer = best.is_none_or(|(distance, lowest, _)| {
                near.distance < distance || (near.distance == distance && index < lowest)
            });
            if near.distance <= within && is_nearer {
                best = Some((near.distance, index, near.point));
            }
        }
        best.map(|(distance, _, point)| (distance, point))
    }
}

impl Clearing<'_> {
    /// Finds what lies round point k: all that can come near to it or to its edges while it moves once.
    pub(crate) fn look_round(&self, points: &[DVec2], k: usize, around: &mut Surroundings) {
        let (here, n) = (points[k], points.len());
        let [before, after] = [(k + n - 1) % n, (k + 1) % n].map(|side| points[side].distance(here));
        // No point of an edge, old or new, is farther away.
        let reach = before.max(after).max(self.moved);
        let spot = Segment::new(here, here);
        let Surroundings { walls, strands } = around;
        walls.clear();
        strands.clear();
        let (off, apart) = (reach + self.off.max(self.apart), reach + self.apart + self.moved);
        // Rounding of a wall at the very distance makes no difference to what is asked.
        self.walls.for_each_near(spot, off, |index, wall| {
            if !wall.is_boxed_beyond(&spot, off) {
                walls.push((index, wall));
            }
        });
        self.edges.for_each_near(spot, apart, |place, edge| {
            if !edge.is_boxed_beyond(&spot, apart) {
                strands.push(self.edge_of[place] as usize);
            }
        });
    }

    /// Whether point k may go to `to`: walls and strands come no nearer than they may, and nothing crosses. `rooted` tells
    /// for the edges before and after the point whether it lies at the root of its excursion.
    pub(crate) fn allows(
        &self,
        points: &[DVec2],
        (k, to): (usize, DVec2),
        rooted: [bool; 2],
        around: &Surroundings,
    ) -> bool {
        let n = points.len();
        let (before, after) = ((k + n - 1) % n, (k + 1) % n);
        let old = [Segment::new(points[before], points[k]), Segment::new(points[k], points[after])];
        let new = [Segment::new(points[before], to), Segment::new(to, points[after])];
        let path = Segment::new(points[k], to);
        if meets_wall(path, around) {
            return false;
        }
        (0..2).all(|side| {
            let edge = if side == 0 { before } else { k };
            self.clears_walls(old[side], new[side], [points[k], to], rooted[side], around)
                && self.clears_strands(points, edge, [old[side], new[side]], around)
        })
    }

    /// Where a point would go to be clear of the strands and walls that are nearer to it than they should be.
    pub(crate) fn push(&self, points: &[DVec2], k: usize, around: &Surroundings) -> DVec2 {
        let (here, n) = (points[k], points.len());
        let away = |p: DVec2, gap: f64, share: f64| {
            let way = here - p;
            let distance = way.length();
            if distance < gap { share * (gap - distance) * way.normalize_or_zero() } else { DVec2::ZERO }
        };
        let mut nearest = (self.apart, here);
        for &other in &around.strands {
            if self.arc_gap(other, k) > self.turn && self.arc_gap((other + 1) % n, k) > self.turn {
                let near = Segment::new(points[other], points[(other + 1) % n]).nearest(here);
                if near.distance < nearest.0 {
                    nearest = (near.distance, near.point);
                }
            }
        }
        let wall = around.nearest_wall(here, self.off).map_or(here, |near| near.1);
        away(nearest.1, self.apart, 0.5) + away(wall, self.off, 1.0)
    }

    fn arc_gap(&self, a: usize, b: usize) -> f64 {
        let gap = (self.arcs[a] - self.arcs[b]).abs();
        gap.min(self.length - gap)
    }

    fn clears_walls(
        &self,
        old: Segment,
        new: Segment,
        [from, to]: [DVec2; 2],
        rooted: bool,
        around: &Surroundings,
    ) -> bool {
        if meets_wall(new, around) {
            return false;
        }
        if rooted {
            let keep = TOUCH * self.apart;
            let distance = |p: DVec2, within: f64| around.nearest_wall(p, within).map(|near| near.0);
            return distance(to, keep)
                .is_none_or(|there| distance(from, f64::INFINITY).is_none_or(|here| there >= here));
        }
        let now = self.gap(new, around);
        now >= self.off || now >= self.gap(old, around) - 1e-9 * self.apart
    }

    /// Distance of an edge from the walls, or what has to be kept if that is less.
    fn gap(&self, edge: Segment, around: &Surroundings) -> f64 {
        let mut gap = self.off;
        for (_, wall) in &around.walls {
            if !wall.is_boxed_beyond(&edge, gap) {
                gap = gap.min(wall.distance_to(&edge));
            }
        }
        gap
    }

    fn clears_strands(
        &self,
        points: &[DVec2],
        edge: usize,
        [old, new]: [Segment; 2],
        around: &Surroundings,
    ) -> bool {
        let n = points.len();
        around.strands.iter().all(|&other| {
            let along = other.abs_diff(edge).min(n - other.abs_diff(edge));
            let strand = Segment::new(points[other], points[if other + 1 < n { other + 1 } else { 0 }]);
            if along <= 1 || strand.is_boxed_beyond(&new, self.apart) {
                return true;
            }
            if self.arc_gap(other, edge) <= self.turn {
                return !strand.crosses(&new);
            }
            let gap = strand.distance_to(&new);
            gap >= self.apart || (gap > 0.0 && gap >= strand.distance_to(&old) - 1e-9 * self.apart)
        })
    }
}

fn meets_wall(path: Segment, around: &Surroundings) -> bool {
    around.walls.iter().any(|(_, wall)| wall.crosses(&path))
}
