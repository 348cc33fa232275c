//! Strand that goes through a wall.
//!
//! Strand that joins a wall runs along it for a while before it leaves, so that the wall is whole where the strand is
//! broken off. Where a wall turns off into the line along a thin part, strand that comes from inside and goes on along that
//! line crosses no loop, and yet pierces the wall as one sees it.

use argil_curve::{ClosedCurve, DVec2, Segment, SegmentIndex};
use geo_types::MultiPolygon;

/// Strand nearer than this to the rim of where a bead fits is on the wall, in w.
const BESIDE: f64 = 1.0 / 12.0;

/// Least length along the wall between one side and the other, in w.
const ALONG: f64 = 1.05;

/// Spacing of the samples, in w: a third of twice [`BESIDE`], so that strand cannot pass a side between two, nor dip to it and back
/// for much longer than this unseen.
const STEP: f64 = 0.05;

/// Samples of a path at most.
const MOST_SAMPLES: f64 = 1e7;

/// Spacing of the samples of a step, in w: a short one has to show its side as well.
const FINE: f64 = 0.02;

/// Where a bead fits in a layer.
pub(crate) struct Walled {
    rings: Vec<ClosedCurve>,
    sides: SegmentIndex,
    width: f64,
}

impl Walled {
    pub(crate) fn new(region: &MultiPolygon<f64>, width: f64) -> Self {
        let rings = region.iter().flat_map(|part| std::iter::once(part.exterior()).chain(part.interiors()));
        let points = rings.map(|ring| ring.0.iter().map(|c| DVec2::new(c.x, c.y)).collect::<Vec<_>>());
        let rings: Vec<ClosedCurve> = points
            .filter_map(|mut ring| {
                ring.dedup();
                if ring.first() == ring.last() {
                    ring.pop();
                }
                ClosedCurve::new(ring).ok()
            })
            .collect();
        let sides = SegmentIndex::of_curves(&rings, width);
        Self { rings, sides, width }
    }

    fn contains(&self, p: DVec2) -> bool {
        self.rings.iter().filter(|ring| ring.contains(p)).count() % 2 == 1
    }

    /// Where a closed path gets from outside to inside, or back, with less than a bead along the wall between.
    ///
    /// # Complexity
    /// O(n k + r s) for n samples with k sides near, and r changes from wall to free strand among s sides.
    pub(crate) fn passages(&self, path: &ClosedCurve) -> Vec<DVec2> {
        if self.rings.is_empty() {
            return Vec::new();
        }
        let spacing = (STEP * self.width).max(path.length() / MOST_SAMPLES);
        let samples = path.resampled(spacing);
        let (count, step) = (samples.len(), path.length() / samples.len() as f64);
        let on_wall = self.on_wall(&samples, step);
        // Once round, from free strand to the same: what begins beside the wall would have no side to come from.
        let Some(first) = on_wall.iter().position(|on| !on) else { return Vec::new() };
        let mut found = Vec::new();
        // The side that the path was on before it met the wall, and how long it has run along the wall since.
        let (mut side, mut run) = (self.contains(samples[first]), 0.0);
        for k in (first + 1..=first + count).map(|k| k % count) {
            if on_wall[k] {
                run += step;
            } else if run > 0.0 {
                let now = self.contains(samples[k]);
                if now != side && run < ALONG * self.width {
                    found.push(samples[k]);
                }
                (side, run) = (now, 0.0);
            }
        }
        found
    }

    /// Which of the samples along a path, at most `step` apart, are on the wall. One look at the middle of three settles all of
    /// them where they are well on it or well off it.
    fn on_wall(&self, samples: &[DVec2], step: f64) -> Vec<bool> {
        let mut on_wall = Vec::with_capacity(samples.len());
        for three in samples.chunks(3) {
            let middle = three[three.len() / 2];
            if self.sides.is_within(middle, BESIDE * self.width - step) {
                on_wall.extend(three.iter().map(|_| true));
            } else if !self.sides.is_within(middle, BESIDE * self.width + step) {
                on_wall.extend(three.iter().map(|_| false));
            } else {
                on_wall.extend(three.iter().map(|&p| !self.is_free(p)));
            }
        }
        on_wall
    }

    /// Whether a step, and the strand behind it, get from one side of the wall to the other with less than a bead along the wall between.
    ///
    /// # Complexity
    /// O(n k) for n samples of the step and a bead of strand, with k sides near.
    pub(crate) fn is_pierced(&self, step: Segment, strand: impl Iterator<Item = Segment>) -> bool {
        let (mut side, mut run) = (None, 0.0);
        for (number, segment) in std::iter::once(step).chain(strand).enumerate() {
            let count = (segment.length() / (FINE * self.width)).ceil().clamp(1.0, 1e7);
            for k in 0..count as usize {
                let p = segment.point_at((k as f64 + 0.5) / count);
                let is_strand = number > 0;
                if !self.is_free(p) {
                    run += segment.length() / count;
                    if is_strand && run >= ALONG * self.width {
                        return false;
                    }
                    continue;
                }
                let now = self.contains(p);
                if side.is_some_and(|side| side != now) && run < ALONG * self.width {
                    return true;
                }
                if is_strand {
                    return false;
                }
                (side, run) = (Some(now), 0.0);
            }
        }
        false
    }

    fn is_free(&self, p: DVec2) -> bool {
        !self.sides.is_within(p, BESIDE * self.width)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geo_types::polygon;

    fn path(points: &[(f64, f64)]) -> ClosedCurve {
        ClosedCurve::new(points.iter().map(|&p| DVec2::from(p)).collect()).unwrap()
    }

    fn tile() -> Walled {
        let tile = polygon![(x: 0.0, y: 0.0), (x: 20.0, y: 0.0), (x: 20.0, y: 20.0), (x: 0.0, y: 20.0)];
        Walled::new(&MultiPolygon(vec![tile]), 1.5)
    }

    #[test]
    fn a_strand_that_runs_along_the_wall_first_joins_it() {
        let joined = path(&[
            (5.0, 0.0),
            (5.0, -3.0),
            (8.0, -3.0),
            (8.0, 0.0),
            (11.0, 0.0),
            (11.0, 4.0),
            (0.0, 4.0),
            (0.0, 0.0),
        ]);
        assert_eq!(tile().passages(&joined), []);
    }

    #[test]
    fn a_strand_that_does_not_goes_through_it() {
        let pierced = path(&[(5.0, -3.0), (8.0, -3.0), (8.0, 0.0), (8.2, 0.0), (8.2, 4.0), (5.0, 4.0)]);
        let found = tile().passages(&pierced);
        assert_eq!(found.len(), 2, "in and out again: {found:?}");
        assert!(found.iter().all(|p| p.y.abs() < 1.0));
    }

    #[test]
    fn where_the_path_begins_makes_no_difference() {
        let corners = [(5.0, -3.0), (8.0, -3.0), (8.0, 0.0), (8.2, 0.0), (8.2, 4.0), (5.0, 4.0)];
        let mut turned = corners;
        for _ in corners {
            turned.rotate_left(1);
            assert_eq!(tile().passages(&path(&turned)).len(), 2, "begun at {:?}", turned[0]);
        }
    }

    #[test]
    fn a_step_onto_the_wall_pierces_it_where_the_strand_leaves_on_the_other_side() {
        let way = |points: &[(f64, f64)]| {
            let points: Vec<DVec2> = points.iter().map(|&p| DVec2::from(p)).collect();
            points.windows(2).map(|pair| Segment::new(pair[0], pair[1])).collect::<Vec<_>>()
        };
        let is_pierced = |points: &[(f64, f64)]| {
            let mut way = way(points).into_iter();
            tile().is_pierced(way.next().unwrap(), way)
        };
        assert!(is_pierced(&[(5.0, -0.4), (5.0, 0.0), (5.6, 0.0), (5.6, 4.0)]), "0.6 mm along the wall");
        assert!(!is_pierced(&[(5.0, -0.4), (5.0, 0.0), (7.0, 0.0), (7.0, 4.0)]), "2 mm along the wall");
        assert!(!is_pierced(&[(5.0, 0.4), (5.0, 0.0), (5.6, 0.0), (5.6, 4.0)]), "from inside to inside");
        assert!(!is_pierced(&[(5.0, -0.1), (5.0, 0.0), (5.6, 0.0), (5.6, 4.0)]), "from the wall itself");
        assert!(is_pierced(&[(5.0, -0.4), (5.0, 0.4), (5.6, 0.4), (5.6, 4.0)]), "straight through");
    }

    #[test]
    fn where_no_bead_fits_there_is_no_wall_to_pierce() {
        let nothing = Walled::new(&MultiPolygon(Vec::new()), 1.5);
        assert_eq!(nothing.passages(&path(&[(0.0, 0.0), (9.0, 0.0), (0.0, 9.0)])), []);
    }
}
