//! Tours over discs: a demand may be met anywhere within its slack, so it moves towards the line between
//! its neighbours on the tour.

use argil_curve::{DVec2, Segment, SegmentIndex};

/// The freedom of the demands of one region.
pub(crate) struct Discs<'a> {
    /// Centres of the discs of each demand: it must stay in all of them.
    pub(crate) anchors: &'a [&'a [DVec2]],
    /// Radius of every disc, mm.
    pub(crate) radius: f64,
    /// The walls of the region.
    pub(crate) walls: &'a SegmentIndex,
    /// A demand keeps this distance from walls, or its own if that is less, mm.
    pub(crate) wall_keep: f64,
}

/// Sweeps over all demands; neighbours move too, so a few are needed.
const SWEEPS: usize = 6;
/// Alternating projections into the discs of a demand with several.
const PROJECTIONS: usize = 4;

impl Discs<'_> {
    /// Moves each demand towards the segment between its two neighbours. `neighbours[d]` holds indices
    /// into `points`, whose first entries are the demands; a demand that is met more than once stays.
    pub(crate) fn relax(&self, points: &mut [DVec2], neighbours: &[Vec<usize>]) {
        let own: Vec<f64> = (0..self.anchors.len()).map(|d| self.walls.distance(points[d])).collect();
        for _ in 0..SWEEPS {
            for (demand, met) in neighbours.iter().enumerate() {
                if let [before, after] = met[..]
                    && let Some(place) = self.place(demand, points[demand], points[before], points[after])
                    && self.walls.distance(place) >= own[demand].min(self.wall_keep) - 1e-9
                    // Nearer than the wall: the move cannot have passed through it.
                    && place.distance(points[demand]) < self.walls.distance(points[demand])
                {
                    points[demand] = place;
                }
            }
        }
    }

    /// The place within all discs that is about nearest to the segment between the neighbours.
    fn place(&self, demand: usize, now: DVec2, before: DVec2, after: DVec2) -> Option<DVec2> {
        let mut place = Segment::new(before, after).nearest(now).point;
        for _ in 0..PROJECTIONS {
            for &anchor in self.anchors[demand] {
                let away = place - anchor;
                if away.length() > self.radius {
                    place = anchor + away.normalize_or_zero() * self.radius;
                }
            }
        }
        let inside = self.anchors[demand].iter().all(|a| a.distance(place) <= 1.02 * self.radius);
        inside.then_some(place)
    }
}
