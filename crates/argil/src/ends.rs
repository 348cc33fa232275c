//! Where the strand may begin and end without being seen.
//!
//! Both ends of a strand show: at its beginning the flow is uneven, at its end a tip of clay is drawn out. On strand that is cut away
//! and on fill they do no harm. On a wall they do the less the fewer directions it can be looked at from: half of all directions on a plain
//! outer wall, a quarter in a corner that is turned inward, none inside of the part.

use std::f64::consts::TAU;

use argil_curve::{DVec2, PointIndex, Segment, SegmentIndex};

/// What an end on a plain outer wall costs, in w²: as much as a chain of steps that goes sixteen w aside over 128 layers.
const SEEN: f64 = 2.0;

/// Directions that are looked from, and the angle of the first, radians: along no axis, since walls often are.
const DIRECTIONS: usize = 16;
const FIRST: f64 = 0.1;

/// What is farther off than this, in w, hides nothing.
const SIGHT: f64 = 40.0;

/// How far before a wall one looks at it, in w: beyond what rounding moves it.
const BEFORE: f64 = 0.05;

/// Places on the walls of a layer at most; the spacing is one w where that gives fewer.
const MOST_PLACES: f64 = 2000.0;

/// How much of the walls of a layer can be seen, place by place.
pub(crate) struct Exposure {
    /// Shares of all directions.
    shares: Vec<f64>,
    places: Vec<DVec2>,
    index: PointIndex,
    spacing: f64,
    width: f64,
}

impl Exposure {
    /// Of the walls of a layer.
    ///
    /// # Complexity
    /// O(n) in the places, and for each the cells of the index within sight.
    pub(crate) fn of(walls: &SegmentIndex, width: f64) -> Self {
        let length: f64 = walls.segments().iter().map(Segment::length).sum();
        let spacing = width.max(length / MOST_PLACES);
        let mut places = Vec::new();
        let mut left = 0.0;
        for wall in walls.segments() {
            let length = wall.length();
            while left < length {
                places.push(wall.point_at(left / length));
                left += spacing;
            }
            left -= length;
        }
        let shares = places.iter().map(|&p| seen(p, walls, width)).collect();
        Self { shares, index: PointIndex::new(&places, spacing), places, spacing, width }
    }

    /// What it costs to end at a place on a wall, mm².
    pub(crate) fn cost(&self, p: DVec2) -> f64 {
        let mut nearest: Option<(f64, usize)> = None;
        self.index.for_each_within(Segment::new(p, p), 2.0 * self.spacing, |k| {
            let found = (self.places[k].distance(p), k);
            if nearest.is_none_or(|best| found < best) {
                nearest = Some(found);
            }
        });
        let share = nearest.map_or(0.5, |(_, k)| self.shares[k]);
        SEEN * self.width * self.width * 2.0 * share
    }
}

/// The share of directions from which a place can be seen past the walls.
fn seen(p: DVec2, walls: &SegmentIndex, width: f64) -> f64 {
    let is_free = |k: &usize| {
        let toward = DVec2::from_angle(FIRST + TAU * *k as f64 / DIRECTIONS as f64);
        let look = Segment::new(p + BEFORE * width * toward, p + SIGHT * width * toward);
        let mut free = true;
        walls.for_each_near(look, 0.0, |_, wall| free &= !wall.crosses(&look));
        free
    };
    (0..DIRECTIONS).filter(is_free).count() as f64 / DIRECTIONS as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_corner_hides_and_the_inside_is_not_seen() {
        // An L, and a square inside of it as a hole has one.
        let outer = [(0.0, 0.0), (40.0, 0.0), (40.0, 20.0), (20.0, 20.0), (20.0, 40.0), (0.0, 40.0)];
        let inner = [(5.0, 5.0), (5.0, 15.0), (15.0, 15.0), (15.0, 5.0)];
        let sides = |ring: &[(f64, f64)]| -> Vec<Segment> {
            let n = ring.len();
            (0..n).map(|k| Segment::new(ring[k].into(), ring[(k + 1) % n].into())).collect()
        };
        let walls = SegmentIndex::new([sides(&outer), sides(&inner)].concat(), 1.5);
        let seen = |x: f64, y: f64| seen(DVec2::new(x, y), &walls, 1.5);
        assert_eq!(seen(10.0, 5.0), 0.0, "inside");
        assert!((seen(10.0, 0.0) - 0.5).abs() < 0.1, "a plain side: {}", seen(10.0, 0.0));
        assert!((seen(20.0, 20.0) - 0.25).abs() < 0.1, "turned inward: {}", seen(20.0, 20.0));
        assert!((seen(40.0, 0.0) - 0.75).abs() < 0.1, "turned outward: {}", seen(40.0, 0.0));
        let exposure = Exposure::of(&walls, 1.5);
        assert!(exposure.cost(DVec2::new(20.0, 20.5)) < exposure.cost(DVec2::new(0.0, 20.0)));
        assert_eq!(exposure.cost(DVec2::new(10.0, 5.0)), 0.0);
    }
}
