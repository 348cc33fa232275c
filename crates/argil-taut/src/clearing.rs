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

impl Clearing<'_> {
    /// Whether point k may go to `to`: walls and strands come no nearer than they may, and nothing crosses. `rooted` tells
    /// for the edges before and after the point whether it lies at the root of its excursion.
    pub(crate) fn allows(&self, points: &[DVec2], k: usize, to: DVec2, rooted: [bool; 2]) -> bool {
        let n = points.len();
        let (before, after) = ((k + n - 1) % n, (k + 1) % n);
        let old = [Segment::new(points[before], points[k]), Segment::new(points[k], points[after])];
        let new = [Segment::new(points[before], to), Segment::new(to, points[after])];
        let path = Segment::new(points[k], to);
        if self.meets_wall(path) {
            return false;
        }
        (0..2).all(|side| {
            let edge = if side == 0 { before } else { k };
            self.clears_walls(old[side], new[side], [points[k], to], rooted[side])
                && self.clears_strands(points, edge, old[side], new[side])
        })
    }

    /// Where a point would go to be clear of the strands and walls that are nearer to it than they should be.
    pub(crate) fn push(&self, points: &[DVec2], k: usize) -> DVec2 {
        let (here, n) = (points[k], points.len());
        let away = |p: DVec2, gap: f64, share: f64| {
            let way = here - p;
            let distance = way.length();
            if distance < gap { share * (gap - distance) * way.normalize_or_zero() } else { DVec2::ZERO }
        };
        let mut nearest = (self.apart, here);
        self.edges.for_each_near(Segment::new(here, here), self.apart + self.moved, |place, _| {
            let other = self.edge_of[place] as usize;
            if self.arc_gap(other, k) > self.turn && self.arc_gap((other + 1) % n, k) > self.turn {
                let near = Segment::new(points[other], points[(other + 1) % n]).nearest(here);
                if near.distance < nearest.0 {
                    nearest = (near.distance, near.point);
                }
            }
        });
        let wall = self.walls.nearest_within(here, self.off).map_or(here, |near| near.point);
        away(nearest.1, self.apart, 0.5) + away(wall, self.off, 1.0)
    }

    fn arc_gap(&self, a: usize, b: usize) -> f64 {
        let gap = (self.arcs[a] - self.arcs[b]).abs();
        gap.min(self.length - gap)
    }

    fn meets_wall(&self, path: Segment) -> bool {
        let mut meets = false;
        self.walls.for_each_near(path, 0.0, |_, wall| meets |= wall.crosses(&path));
        meets
    }

    fn clears_walls(&self, old: Segment, new: Segment, [from, to]: [DVec2; 2], rooted: bool) -> bool {
        if self.meets_wall(new) {
            return false;
        }
        if rooted {
            let keep = TOUCH * self.apart;
            return self
                .walls
                .nearest_within(to, keep)
                .is_none_or(|near| near.distance >= self.walls.distance(from));
        }
        let now = self.gap(new);
        now >= self.off || now >= self.gap(old) - 1e-9 * self.apart
    }

    /// Distance of an edge from the walls, or what has to be kept if that is less.
    fn gap(&self, edge: Segment) -> f64 {
        let mut gap = self.off;
        self.walls.for_each_near(edge, self.off, |_, wall| {
            if !wall.is_boxed_beyond(&edge, gap) {
                gap = gap.min(wall.distance_to(&edge));
            }
        });
        gap
    }

    fn clears_strands(&self, points: &[DVec2], edge: usize, old: Segment, new: Segment) -> bool {
        let n = points.len();
        let mut clear = true;
        self.edges.for_each_near(new, self.apart + self.moved, |place, _| {
            let other = self.edge_of[place] as usize;
            let along = other.abs_diff(edge).min(n - other.abs_diff(edge));
            if !clear || along <= 1 {
                return;
            }
            let strand = Segment::new(points[other], points[(other + 1) % n]);
            if strand.is_boxed_beyond(&new, self.apart) {
                return;
            }
            if self.arc_gap(other, edge) <= self.turn {
                clear = !strand.crosses(&new);
                return;
            }
            let gap = strand.distance_to(&new);
            clear = gap >= self.apart || (gap > 0.0 && gap >= strand.distance_to(&old) - 1e-9 * self.apart);
        });
        clear
    }
}
