//! Mending: the nearest strand makes a detour into what would stay bare.

use argil_curve::{ClosedCurve, DVec2, Segment, SegmentIndex, on_grid};

use crate::bare::BareDisc;
use crate::curve::{Bead, FillCurve};

/// A stretch of a curve that is replaced by two straight legs.
#[derive(Clone, Copy, Debug)]
struct Detour {
    curve: usize,
    /// Arc at which it begins, and how much of the curve it replaces.
    start: f64,
    taken: f64,
    corners: [DVec2; 3],
}

/// Detours that are tried: how far towards the middle of the disc, half of the replaced stretch in w.
const TOWARDS: [f64; 3] = [1.0, 0.8, 0.6];
const HALVES: [f64; 5] = [0.5, 0.35, 0.2, 0.1, 0.05];

/// Shifts along the strand that are tried, in w.
const SHIFT: f64 = 0.2;
const SHIFTS: i32 = 6;

/// What a shift of one bead is worth in length of detour.
const SHIFT_COST: f64 = 0.3;

/// A spur from a wall counts as so much longer, in w: others are taken where there is a choice.
const WALL_COST: f64 = 0.5;

/// Strand this near to the ends of a detour, along the curve, only must not be crossed; in w.
const BESIDE: f64 = 0.3;

/// A tip keeps so far away from all other strand, in w.
const TIP_APART: f64 = 0.45;

/// Legs of fill keep so far away from the edge of their region, in w: half a bead, but for what rings lose at corners that are cut.
const EDGE_APART: f64 = 0.475;

/// Legs keep so far away from strand that is not beside their ends, in w.
const LEG_APART: f64 = 0.1;

/// Gives the curves a detour into each disc that has room for one, and tells where: the boxes round them.
///
/// A detour takes no more than `wall_cut` (mm) out of a wall: there it is a spur.
pub(crate) fn mended(
    curves: &mut [FillCurve],
    strand: &Strand<'_>,
    discs: &[BareDisc],
    wall_cut: f64,
) -> Vec<[DVec2; 2]> {
    let mut made: Vec<Detour> = Vec::new();
    for disc in discs {
        made.extend(strand.detour(disc, curves, wall_cut, &made));
    }
    for (k, curve) in curves.iter_mut().enumerate() {
        if let Some(closed) = &strand.closed[k] {
            let own: Vec<Detour> = made.iter().filter(|detour| detour.curve == k).copied().collect();
            if !own.is_empty() {
                *curve = replaced(curve, closed, own);
            }
        }
    }
    made.iter()
        .map(|detour| {
            let [from, tip, to] = detour.corners;
            // What it replaces lies within half its length of one of its ends.
            let around = 0.5 * detour.taken;
            [from.min(to).min(tip + around) - around, from.max(to).max(tip - around) + around]
        })
        .collect()
}

/// All strand, for questions of distance.
pub(crate) struct Strand<'a> {
    pub(crate) index: SegmentIndex,
    /// The edges of the region, which no detour of fill crosses.
    edges: &'a SegmentIndex,
    /// Each curve, if its segments have the same numbers as its beads.
    closed: Vec<Option<ClosedCurve>>,
    /// Curve and segment of each segment of the index.
    owner: Vec<(usize, usize)>,
    width: f64,
    grid: f64,
}

impl<'a> Strand<'a> {
    pub(crate) fn new(curves: &[FillCurve], edges: &'a SegmentIndex, width: f64, grid: f64) -> Self {
        let mut owner: Vec<(usize, usize)> = Vec::new();
        let mut segments: Vec<Segment> = Vec::new();
        for (k, curve) in curves.iter().enumerate() {
            let points = &curve.points;
            owner.extend((0..points.len()).map(|segment| (k, segment)));
            segments
                .extend((0..points.len()).map(|k| Segment::new(points[k], points[(k + 1) % points.len()])));
        }
        // A curve whose points repeat would have other indices than its beads.
        let closed = curves
            .iter()
            .map(|curve| {
                let closed = ClosedCurve::new(curve.points.clone()).ok();
                closed.filter(|c| c.segment_count() == curve.points.len())
            })
            .collect();
        Self { index: SegmentIndex::new(segments, width), edges, closed, owner, width, grid }
    }

    /// The nearest segments of fill and of wall.
    fn nearest(&self, disc: &BareDisc, curves: &[FillCurve]) -> [Option<(usize, usize)>; 2] {
        let mut best: [Option<(f64, (usize, usize))>; 2] = [None; 2];
        let spot = Segment::new(disc.centre, disc.centre);
        self.index.for_each_near(spot, 0.5 * disc.diameter + 1.2 * self.width, |k, segment| {
            let (curve, own) = self.owner[k];
            let distance = segment.distance(disc.centre);
            let best = &mut best[usize::from(matches!(curves[curve].beads[own], Bead::Wall(_)))];
            if best.is_none_or(|(least, at)| distance < least || (distance <= least && (curve, own) < at)) {
                *best = Some((distance, (curve, own)));
            }
        });
        best.map(|best| best.map(|(_, at)| at))
    }

    /// The cheapest detour from near the nearest segments to the middle of a disc; the fullest that is possible.
    fn detour(
        &self,
        disc: &BareDisc,
        curves: &[FillCurve],
        wall_cut: f64,
        made: &[Detour],
    ) -> Option<Detour> {
        let bases = self.nearest(disc, curves);
        for towards in TOWARDS {
            let mut tried: Vec<(f64, Detour)> = Vec::new();
            for (number, segment) in bases.into_iter().flatten() {
                let Some(curve) = &self.closed[number] else { continue };
                let near = curve.on_segment(segment, disc.centre);
                let on_grid = |p: DVec2| on_grid(p, self.grid);
                let tip = on_grid(near.point.lerp(disc.centre, towards));
                let is_wall = matches!(curves[number].beads[segment], Bead::Wall(_));
                for half in HALVES.map(|half| half * self.width) {
                    if is_wall && 2.0 * half > wall_cut * 1.001 {
                        continue;
                    }
                    for shift in -SHIFTS..=SHIFTS {
                        let shift = f64::from(shift) * SHIFT * self.width;
                        let start = near.s + shift - half;
                        let corner = |arc: f64| on_grid(curve.point_at(arc));
                        let corners = [corner(start), tip, corner(start + 2.0 * half)];
                        let detour =
                            Detour { curve: number, start: curve.wrapped(start), taken: 2.0 * half, corners };
                        let length = corners[0].distance(tip) + corners[2].distance(tip);
                        let extra = if is_wall { WALL_COST * self.width } else { 0.0 };
                        tried.push((length - 2.0 * half + SHIFT_COST * shift.abs() + extra, detour));
                    }
                }
            }
            tried.sort_by(|a, b| a.0.total_cmp(&b.0));
            let fits = |detour: &Detour| {
                let curve = self.closed[detour.curve].as_ref();
                curve.is_some_and(|c| self.fits(detour, c, &curves[detour.curve].beads, wall_cut, made))
            };
            if let Some((_, detour)) = tried.into_iter().find(|(_, detour)| fits(detour)) {
                return Some(detour);
            }
        }
        None
    }

    fn fits(
        &self,
        detour: &Detour,
        curve: &ClosedCurve,
        beads: &[Bead],
        wall_cut: f64,
        made: &[Detour],
    ) -> bool {
        let (n, length) = (curve.segment_count(), curve.length());
        if detour.taken > 0.25 * length {
            return false;
        }
        // What is replaced must be no wall, nor the ends of its neighbours, unless it is no more than a joint takes.
        let first = curve.locate(detour.start).segment;
        let last = curve.locate(curve.wrapped(detour.start + detour.taken)).segment;
        let count = (last + n - first) % n + 1;
        let walls = (0..count).filter(|k| matches!(beads[(first + k) % n], Bead::Wall(_))).count();
        if walls > 0 && (walls < count || detour.taken > wall_cut * 1.001) {
            return false;
        }
        let margin = 0.1 * self.width;
        let meets = |other: &Detour| {
            let gap = (other.start - detour.start).rem_euclid(length);
            other.curve == detour.curve
                && (gap < detour.taken + margin || length - gap < other.taken + margin)
        };
        if made.iter().any(meets) {
            return false;
        }
        let [from, tip, to] = detour.corners;
        let legs = [Segment::new(from, tip), Segment::new(to, tip)];
        let mut clear = true;
        for leg in legs {
            // Walls that were given lie beside the region, and those of its own shut it in.
            if walls == 0 {
                let away = EDGE_APART * self.width;
                self.edges.for_each_near(leg, away, |_, edge| clear &= leg.distance_to(&edge) >= away);
            }
            // Its base lies on the curve itself.
            let inner = Segment::new(leg.point_at(0.05), tip);
            self.index.for_each_near(leg, LEG_APART * self.width, |k, other| {
                let (number, own) = self.owner[k];
                let place = if number == detour.curve { (own + n - first) % n } else { usize::MAX };
                // Strictly inside of what is replaced: it will be gone.
                let gone = place != usize::MAX && place > 0 && place + 1 < count;
                let beside = number == detour.curve && {
                    let before = detour.start - curve.arc_of(own) - other.length();
                    let after = curve.arc_of(own) - detour.start - detour.taken;
                    let touched = |gap: f64| (gap.rem_euclid(length)) <= BESIDE * self.width;
                    place == 0
                        || place + 1 == count
                        || place == count
                        || place == n - 1
                        || touched(before)
                        || touched(after)
                };
                clear &= gone
                    || if beside {
                        !remains_crossed(leg, other, detour, curve, own)
                    } else {
                        !leg.crosses(&other) && inner.distance_to(&other) >= LEG_APART * self.width
                    };
            });
        }
        if !clear {
            return false;
        }
        let mut tip_clear = true;
        self.index.for_each_near(Segment::new(tip, tip), TIP_APART * self.width, |k, other| {
            let (number, own) = self.owner[k];
            let replaced = number == detour.curve && (own + n - first) % n < count;
            tip_clear &= replaced || other.distance(tip) >= TIP_APART * self.width;
        });
        let others = made.iter().flat_map(|d| {
            [Segment::new(d.corners[0], d.corners[1]), Segment::new(d.corners[1], d.corners[2])]
        });
        tip_clear
            && others
                .into_iter()
                .all(|other| legs.iter().all(|leg| leg.distance_to(&other) > LEG_APART * self.width))
    }
}

/// Whether a leg crosses what remains of a segment beside the detour.
fn remains_crossed(leg: Segment, other: Segment, detour: &Detour, curve: &ClosedCurve, own: usize) -> bool {
    let length = curve.length();
    let into = (detour.start - curve.arc_of(own)).rem_euclid(length);
    let out = (detour.start + detour.taken - curve.arc_of(own)).rem_euclid(length);
    let size = other.length();
    // What remains ends where the legs begin, on the grid.
    let before = (into < size).then(|| Segment::new(other.start, detour.corners[0]));
    let after = (out < size).then(|| Segment::new(detour.corners[2], other.end));
    match (before, after) {
        (None, None) => leg.crosses(&other),
        parts => [parts.0, parts.1].into_iter().flatten().any(|part| leg.crosses(&part)),
    }
}

/// The curve with its detours in place of what they replace.
fn replaced(curve: &FillCurve, closed: &ClosedCurve, mut detours: Vec<Detour>) -> FillCurve {
    let (n, length) = (closed.segment_count(), closed.length());
    detours.sort_by(|a, b| a.start.total_cmp(&b.start));
    let mut result = FillCurve::default();
    for (number, detour) in detours.iter().enumerate() {
        let next = detours[(number + 1) % detours.len()];
        let [from, tip, to] = detour.corners;
        result.push(from, Bead::Joint);
        result.push(tip, Bead::Joint);
        let end = closed.wrapped(detour.start + detour.taken);
        let first = closed.locate(end).segment;
        result.push(to, curve.beads[first]);
        let span =
            if detours.len() == 1 { length - detour.taken } else { (next.start - end).rem_euclid(length) };
        for k in 0..n {
            let vertex = (first + 1 + k) % n;
            if (closed.arc_of(vertex) - end).rem_euclid(length) >= span {
                break;
            }
            result.push(curve.points[vertex], curve.beads[vertex]);
        }
    }
    result.close();
    result.flow = vec![1.0; result.points.len()];
    result
}
