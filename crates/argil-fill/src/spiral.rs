//! Chains of rings without a branch as one closed double spiral.

use argil_curve::{ClosedCurve, DVec2, Segment, SegmentIndex, rounded, self_crossings};

use crate::ring::{LEAST_SIDE, Ring};

/// Along so many w of every ring the strand passes from one ring to the next but one.
const SHIFT: f64 = 4.0;

/// Fewer rings make no spiral.
const LEAST_RINGS: usize = 3;

/// Rings shorter than this, in w, turn too much for a shift.
const LEAST_LENGTH: f64 = 3.0 * SHIFT;

/// Rings that lie side by side are no farther apart than this where the strand passes, in w: more would leave a gap.
const FARTHEST: f64 = 1.6;

/// At either end of the spiral its two arms turn into each other so far along the shift: nearer to its middle they would lie on each
/// other, farther away they would leave a wedge bare.
const TURN: f64 = 0.3;

/// Spacing of the vertices of a shift, in w.
const STEP: f64 = 0.25;

/// What arms keep from each other, in w. Where they shift they lie 0.89 w apart.
const APART: f64 = 0.45;

/// Along itself, what is nearer than this on an arm is the same strand, in w.
const SAME: f64 = 2.5;

/// Puts one closed double spiral in place of every chain of rings that lie in each other without a branch.
///
/// Every ring is cut at one place and led on to the next but one over four beads' length: one arm takes the even rings and one the odd
/// ones, and at both ends they turn into each other. So a chain of any length needs no joint, and turns back twice. Rings that are walls,
/// and rings about which more than one other lies, stay as they are; so does a chain of which no sound spiral can be made.
///
/// # Complexity
/// Each ring is looked for in all others; the rest is near linear in their vertices.
pub(crate) fn with_spirals(rings: Vec<Ring>, width: f64, grid: f64) -> Vec<Ring> {
    let curves: Vec<Option<ClosedCurve>> =
        rings.iter().map(|ring| ClosedCurve::new(ring.points.clone()).ok().map(left_handed)).collect();
    let chains = chains(&rings, &curves, width);
    let mut replaced = vec![false; rings.len()];
    let mut spirals = Vec::new();
    for chain in chains {
        let own: Vec<&ClosedCurve> = chain.iter().filter_map(|&k| curves[k].as_ref()).collect();
        if let Some(points) = spiral(&own, width, grid) {
            chain.iter().for_each(|&k| replaced[k] = true);
            spirals.push(Ring { points, wall: None });
        }
    }
    let kept = rings.into_iter().zip(replaced).filter(|(_, replaced)| !replaced).map(|(ring, _)| ring);
    kept.chain(spirals).collect()
}

/// The curve run through so that its inside is on the left.
fn left_handed(curve: ClosedCurve) -> ClosedCurve {
    if curve.signed_area() >= 0.0 {
        return curve;
    }
    let turned = curve.points().iter().rev().copied().collect();
    ClosedCurve::new(turned).unwrap_or(curve)
}

/// Rings that lie in each other, each directly within the one before and with no other beside it, the outermost first.
fn chains(rings: &[Ring], curves: &[Option<ClosedCurve>], width: f64) -> Vec<Vec<usize>> {
    let area = |k: usize| curves[k].as_ref().map_or(0.0, ClosedCurve::signed_area);
    let parent = |k: usize| {
        let at = *rings[k].points.first()?;
        let around = (0..rings.len())
            .filter(|&other| other != k && curves[other].as_ref().is_some_and(|curve| curve.contains(at)));
        around.min_by(|&a, &b| area(a).total_cmp(&area(b)).then(a.cmp(&b)))
    };
    let parents: Vec<Option<usize>> = (0..rings.len()).map(parent).collect();
    let mut children: Vec<Vec<usize>> = vec![Vec::new(); rings.len()];
    for (k, parent) in parents.iter().enumerate() {
        if let Some(parent) = parent {
            children[*parent].push(k);
        }
    }
    let fits = |k: usize| {
        let length = curves[k].as_ref().map_or(0.0, ClosedCurve::length);
        rings[k].wall.is_none() && length >= LEAST_LENGTH * width
    };
    let follows = |k: usize| match children[k][..] {
        [only] if fits(only) => Some(only),
        _ => None,
    };
    let mut chains = Vec::new();
    for first in (0..rings.len()).filter(|&k| fits(k)) {
        if parents[first].is_some_and(|parent| fits(parent) && follows(parent) == Some(first)) {
            continue;
        }
        let mut chain = vec![first];
        while let Some(next) = follows(chain[chain.len() - 1]) {
            chain.push(next);
        }
        if chain.len() >= LEAST_RINGS {
            chains.push(chain);
        }
    }
    chains
}

/// Rings with the arc of each at which the strand passes on.
struct Seam<'a> {
    rings: &'a [&'a ClosedCurve],
    arcs: Vec<f64>,
    shift: f64,
}

impl<'a> Seam<'a> {
    /// The places on all rings from the innermost outwards, each the nearest to the one before, if no two of them are too far apart.
    fn through(rings: &'a [&'a ClosedCurve], start: f64, width: f64) -> Option<Self> {
        let innermost = rings.last()?;
        let mut arcs = vec![0.0; rings.len()];
        let mut at = innermost.point_at(start);
        arcs[rings.len() - 1] = start;
        for k in (0..rings.len() - 1).rev() {
            let near = rings[k].nearest(at);
            if near.distance > FARTHEST * width {
                return None;
            }
            (arcs[k], at) = (near.s, near.point);
        }
        Some(Self { rings, arcs, shift: SHIFT * width })
    }

    /// The place on a ring beside a share of the shift.
    fn beside(&self, ring: usize, share: f64) -> DVec2 {
        let curve = self.rings[ring];
        curve.point_at(curve.wrapped(self.arcs[ring] + (share - 0.5) * self.shift))
    }

    /// Strand along the shift from one share of it to another; `at` says where it lies at a share.
    fn drawn(&self, shares: [f64; 2], width: f64, at: impl Fn(f64) -> DVec2) -> Vec<DVec2> {
        let count = ((shares[1] - shares[0]).abs() * self.shift / (STEP * width)).ceil().max(1.0) as usize;
        (0..=count).map(|k| at(shares[0] + (shares[1] - shares[0]) * k as f64 / count as f64)).collect()
    }

    /// A ring from the end of its shift round to where it begins, without the ends.
    fn round(&self, ring: usize) -> Vec<DVec2> {
        let curve = self.rings[ring];
        let from = curve.wrapped(self.arcs[ring] + 0.5 * self.shift);
        let span = curve.length() - self.shift;
        let (n, first) = (curve.segment_count(), curve.locate(from).segment);
        let vertices = (1..=n).map(|k| (first + k) % n);
        let gone = |vertex: usize| (curve.arc_of(vertex) - from).rem_euclid(curve.length());
        vertices.take_while(|&vertex| gone(vertex) < span).map(|vertex| curve.points()[vertex]).collect()
    }

    /// One arm, over every second ring: `first` is 0 or 1.
    fn arm(&self, first: usize, width: f64) -> Vec<DVec2> {
        let last = self.rings.len() - 1;
        let beside = |ring: usize| move |share: f64| self.beside(ring, share);
        let between = |a: usize, b: usize, share: f64, part: f64| {
            self.beside(a, share).lerp(self.beside(b, share), part)
        };
        // Outside of the first ring the arms turn into each other: along ring 0, and aslant towards ring 1.
        let mut arm = match first {
            0 => self.drawn([1.0 - TURN, 1.0], width, beside(0)),
            _ => self.drawn([1.0 - TURN, 1.0], width, |share| between(0, 1, share, 2.0 * share - 1.0)),
        };
        let mut ring = first;
        loop {
            arm.extend(self.round(ring));
            if ring + 2 > last {
                break;
            }
            arm.extend(self.drawn([0.0, 1.0], width, |share| between(ring, ring + 2, share, share)));
            ring += 2;
        }
        // So they do within the last one.
        arm.extend(match ring {
            _ if ring == last => self.drawn([0.0, TURN], width, beside(last)),
            _ => self.drawn([0.0, TURN], width, |share| between(ring, last, share, 2.0 * share)),
        });
        arm
    }
}

/// Places of the innermost ring at which a spiral is tried.
const TRIES: usize = 8;

/// A closed double spiral through rings, outermost first, on the grid; `None` where none is sound.
fn spiral(rings: &[&ClosedCurve], width: f64, grid: f64) -> Option<Vec<DVec2>> {
    let innermost = rings.last()?;
    (0..TRIES).find_map(|k| {
        let start = innermost.length() * k as f64 / TRIES as f64;
        let seam = Seam::through(rings, start, width)?;
        let mut points = seam.arm(0, width);
        points.extend(seam.arm(1, width).into_iter().rev());
        let points = rounded(&points, grid, LEAST_SIDE * grid);
        is_sound(&points, width).then_some(points)
    })
}

/// Whether a closed path crosses itself nowhere and keeps apart from itself.
fn is_sound(points: &[DVec2], width: f64) -> bool {
    if points.len() < 3 || !self_crossings(points).is_empty() {
        return false;
    }
    let Ok(curve) = ClosedCurve::new(points.to_vec()) else { return false };
    let index = SegmentIndex::of_curves([&curve], width);
    let count = (curve.length() / (0.5 * width)).ceil().min(1e6) as usize;
    (0..count).all(|k| {
        let arc = curve.length() * k as f64 / count as f64;
        let at = curve.point_at(arc);
        let spot = Segment::new(at, at);
        let mut apart = true;
        index.for_each_near(spot, APART * width, |segment, side| {
            let near = curve.arc_of(segment) + curve.points()[segment].distance(side.nearest(at).point);
            apart &= side.distance(at) >= APART * width || curve.arc_gap(near, arc) < SAME * width;
        });
        apart
    })
}
