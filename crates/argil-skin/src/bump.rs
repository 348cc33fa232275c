//! Lanes of a fill that give way to what the layer above needs.

use argil_curve::{ClosedCurve, DVec2, Segment, SegmentIndex, on_grid};

use crate::ModelLoop;
use crate::apart::is_apart;

/// How lanes give way.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Bumps {
    /// Bead width w, mm.
    pub width: f64,
    /// How near a lane must come to a need, mm.
    pub within: f64,
    /// The farthest that a lane gives way, mm.
    pub most: f64,
    /// Step of the output coordinates, mm.
    pub grid: f64,
}

/// Half lengths of lane that a bump takes the place of, in w; the first that fits is taken.
const HALVES: [f64; 5] = [0.5, 0.35, 0.22, 0.12, 0.8];

/// What a bump keeps from other lanes, in w.
const APART: f64 = 0.25;

/// Along the lane itself, what is nearer than this to a bump is beside it, in w.
const BESIDE: f64 = 0.6;

/// Lane between two bumps, in w.
const BETWEEN: f64 = 0.05;

/// A corner in place of a stretch of lane.
#[derive(Clone, Copy, Debug)]
struct Bump {
    number: usize,
    /// Arc of its middle, and half of what it replaces.
    arc: f64,
    half: f64,
    corners: [DVec2; 3],
}

impl Bump {
    fn legs(&self) -> [Segment; 2] {
        let [from, tip, to] = self.corners;
        [Segment::new(from, tip), Segment::new(tip, to)]
    }
}

/// Lets the nearest lane of fill come [within](Bumps::within) reach of each of these needs, where it can without touching another lane or
/// a wall. Returns how many bumps were made.
///
/// Walls stay as they are, bit by bit, and no loop crosses itself or another afterwards that did not before. One call makes at
/// most one bump for a need and none where two would meet, so that a caller who looks again may call again.
///
/// # Complexity
/// Near linear in the vertices of the loops, times the bumps that are near each other.
///
/// # Example
/// ```
/// use argil_skin::{Bumps, DVec2, ModelLoop, bumped};
/// let corners = [(0.0, 0.0), (20.0, 0.0), (20.0, 20.0), (0.0, 20.0)];
/// let lane = ModelLoop { points: corners.map(DVec2::from).to_vec(), fill: true, parent: None };
/// let mut loops = [lane];
/// let bumps = Bumps { width: 1.5, within: 0.2, most: 0.6, grid: 1e-4 };
/// assert_eq!(bumped(&mut loops, &[DVec2::new(10.0, 0.7)], &bumps), 1);
/// let tip = loops[0].points[1];
/// assert!(tip.distance(DVec2::new(10.0, 0.7)) < 0.2);
/// ```
pub fn bumped(loops: &mut [ModelLoop], needs: &[DVec2], bumps: &Bumps) -> usize {
    let usable = [bumps.width, bumps.within, bumps.most, bumps.grid];
    if usable.iter().any(|value| !(*value > 0.0 && value.is_finite())) {
        return 0;
    }
    let curves: Vec<Option<ClosedCurve>> =
        loops.iter().map(|one| ClosedCurve::new(one.points.clone()).ok()).collect();
    let sides = || {
        let known = curves.iter().enumerate().filter_map(|(k, curve)| Some((k, curve.as_ref()?)));
        known
            .flat_map(|(k, curve)| (0..curve.segment_count()).map(move |side| (k, side, curve.segment(side))))
    };
    let lanes = Lanes {
        loops,
        curves: &curves,
        index: SegmentIndex::new(sides().map(|(_, _, side)| side).collect(), bumps.width),
        owner: sides().map(|(k, side, _)| (k, side)).collect(),
        bumps,
    };
    let mut made: Vec<Bump> = Vec::new();
    for &need in needs.iter().filter(|need| need.is_finite()) {
        made.extend(lanes.bump(need, &made));
    }
    let changed: Vec<(usize, ModelLoop, usize)> = (0..loops.len())
        .filter_map(|number| {
            let own: Vec<Bump> = made.iter().filter(|bump| bump.number == number).copied().collect();
            let curve = curves[number].as_ref().filter(|_| !own.is_empty())?;
            let (next, count) = with_bumps(&loops[number], curve, own, bumps.grid);
            Some((number, next, count))
        })
        .collect();
    changed
        .into_iter()
        .map(|(number, next, count)| {
            loops[number] = next;
            count
        })
        .sum()
}

/// The loop with as many of the bumps as leave it apart from itself: all of them, or else one after the other.
fn with_bumps(one: &ModelLoop, curve: &ClosedCurve, bumps: Vec<Bump>, grid: f64) -> (ModelLoop, usize) {
    let count = bumps.len();
    let whole = replaced(one, curve, bumps.clone());
    if is_apart(&whole.points, grid) {
        return (whole, count);
    }
    let (mut kept, mut next) = (Vec::new(), one.clone());
    for bump in bumps {
        kept.push(bump);
        let tried = replaced(one, curve, kept.clone());
        if is_apart(&tried.points, grid) {
            next = tried;
        } else {
            kept.pop();
        }
    }
    (next, kept.len())
}

struct Lanes<'a> {
    loops: &'a [ModelLoop],
    curves: &'a [Option<ClosedCurve>],
    index: SegmentIndex,
    /// Loop and segment of each segment of the index.
    owner: Vec<(usize, usize)>,
    bumps: &'a Bumps,
}

impl Lanes<'_> {
    /// A bump of the nearest lane that is fill towards a need.
    fn bump(&self, need: DVec2, made: &[Bump]) -> Option<Bump> {
        let Bumps { width, within, most, grid } = *self.bumps;
        let mut best: Option<(f64, usize)> = None;
        self.index.for_each_near(Segment::new(need, need), within + most, |k, side| {
            let (number, _) = self.owner[k];
            let distance = side.distance(need);
            if self.loops[number].fill && best.is_none_or(|(least, at)| (distance, k) < (least, at)) {
                best = Some((distance, k));
            }
        });
        let (distance, k) = best?;
        // What is near enough already stays; half of the reach is left for rounding and for what is laid over it.
        if distance <= within {
            return None;
        }
        let (number, own) = self.owner[k];
        let curve = self.curves[number].as_ref()?;
        let near = curve.on_segment(own, need);
        let share = ((distance - 0.5 * within) / distance).min(most / distance);
        let on_grid = |p: DVec2| on_grid(p, grid);
        let tip = on_grid(near.point.lerp(need, share));
        HALVES.iter().find_map(|half| {
            let half = half * width;
            let [from, to] =
                [near.s - half, near.s + half].map(|arc| on_grid(curve.point_at(curve.wrapped(arc))));
            let bump = Bump { number, arc: near.s, half, corners: [from, tip, to] };
            (tip.distance(need) <= within && self.fits(&bump, curve, made)).then_some(bump)
        })
    }

    fn fits(&self, bump: &Bump, curve: &ClosedCurve, made: &[Bump]) -> bool {
        let width = self.bumps.width;
        if bump.half > 0.1 * curve.length() {
            return false;
        }
        let meets = |other: &&Bump| {
            other.number == bump.number
                && curve.arc_gap(other.arc, bump.arc) < other.half + bump.half + BETWEEN * width
        };
        if made.iter().any(|other| meets(&other)) {
            return false;
        }
        let apart = APART * width;
        let clear_of_others = made.iter().all(|other| {
            let far = other.corners[1].distance(bump.corners[1]) > 4.0 * width;
            far || other.legs().iter().all(|leg| bump.legs().iter().all(|own| own.distance_to(leg) >= apart))
                || curve_neighbours(curve, other, bump, width)
        });
        clear_of_others && bump.legs().iter().all(|leg| self.is_clear(leg, bump, curve, apart))
    }

    /// Whether a leg of a bump keeps away from everything but its own lane, and does not cross that.
    fn is_clear(&self, leg: &Segment, bump: &Bump, curve: &ClosedCurve, apart: f64) -> bool {
        let mut clear = true;
        self.index.for_each_near(*leg, apart, |k, side| {
            let (number, own) = self.owner[k];
            if number == bump.number {
                let begin = curve.arc_of(own) - bump.arc;
                if self.is_beside(begin, side.length(), bump, curve.length()) {
                    clear &= rest_of(&side, begin, bump.half, curve.length())
                        .iter()
                        .all(|rest| !leg.crosses(rest));
                    return;
                }
            }
            clear &= side.distance_to(leg) >= apart;
        });
        clear
    }

    /// Whether a segment of the lane, which begins so far behind the middle of a bump, comes near it along the lane.
    fn is_beside(&self, begin: f64, length: f64, bump: &Bump, turn: f64) -> bool {
        let reach = bump.half + BESIDE * self.bumps.width;
        let begin = (begin + reach).rem_euclid(turn);
        begin <= 2.0 * reach || begin + length >= turn
    }
}

/// Bumps of one lane that follow each other closely touch where both are still on the lane.
fn curve_neighbours(curve: &ClosedCurve, other: &Bump, bump: &Bump, width: f64) -> bool {
    other.number == bump.number
        && curve.arc_gap(other.arc, bump.arc) < other.half + bump.half + BESIDE * width
        && !other.legs().iter().any(|leg| bump.legs().iter().any(|own| own.crosses(leg)))
}

/// What a bump leaves of a segment that begins so far behind its middle.
fn rest_of(side: &Segment, begin: f64, half: f64, turn: f64) -> Vec<Segment> {
    let length = side.length();
    let begin = if begin > 0.5 * turn {
        begin - turn
    } else if begin < -0.5 * turn {
        begin + turn
    } else {
        begin
    };
    let share = |arc: f64| ((arc - begin) / length).clamp(0.0, 1.0);
    let (from, to) = (share(-half), share(half));
    let before = (from > 0.0).then(|| Segment::new(side.start, side.point_at(from)));
    let after = (to < 1.0).then(|| Segment::new(side.point_at(to), side.end));
    [before, after].into_iter().flatten().collect()
}

/// The loop with bumps in place of what they replace.
fn replaced(one: &ModelLoop, curve: &ClosedCurve, mut bumps: Vec<Bump>) -> ModelLoop {
    let (n, turn) = (curve.segment_count(), curve.length());
    bumps.sort_by(|a, b| a.arc.total_cmp(&b.arc));
    let mut points: Vec<DVec2> = Vec::new();
    let mut push = |point: DVec2| {
        if points.last() != Some(&point) {
            points.push(point);
        }
    };
    for (k, bump) in bumps.iter().enumerate() {
        bump.corners.iter().for_each(|&corner| push(corner));
        let following = bumps[(k + 1) % bumps.len()];
        let from = bump.arc + bump.half;
        let gap = (following.arc - following.half - from).rem_euclid(turn);
        let first = curve.locate(curve.wrapped(from)).segment;
        for step in 1..=n {
            let vertex = (first + step) % n;
            if (curve.arc_of(vertex) - from).rem_euclid(turn) >= gap {
                break;
            }
            push(curve.points()[vertex]);
        }
    }
    while points.len() > 1 && points.first() == points.last() {
        points.pop();
    }
    ModelLoop { points, ..*one }
}
