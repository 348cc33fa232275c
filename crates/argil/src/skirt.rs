//! Turns on the bed round the lowest layer, and the way from them to its start.

use std::f64::consts::TAU;

use argil_curve::{ClosedCurve, DVec2, Segment, SegmentIndex, on_grid};
use argil_strand::{Move, Role};

use crate::settings::NEAREST_SKIRT;
use crate::{Bed, Skirt, SkirtLaid};

/// The skirt comes nearer in steps of this, in w, where the bed has not enough room.
const NEARER: f64 = 0.25;

/// Most such steps: a skirt that is farther off than they lead is tried at the least distance next.
const MOST_NEARER: usize = 400;

/// The angle between neighbouring points where the skirt goes round a corner, radians.
const CORNER: f64 = TAU / 60.0;

/// The spacing of points along its sides, in w.
const SIDE: f64 = 2.0;

/// How far along the way the part's strand is left behind, in w, and how far off it is from there on.
const LEAVES: (f64, f64) = (1.0, 0.7);

/// How far from its start a way is looked at for crossings, in w.
const BESIDE: f64 = 0.02;

/// How many points of the skirt a way is sought from, the nearest first.
const WAYS: usize = 24;

/// A place on the hull of the lowest layer, and the direction outward.
#[derive(Clone, Copy)]
struct Station {
    base: DVec2,
    outward: DVec2,
}

impl Station {
    fn at(&self, radius: f64) -> DVec2 {
        self.base + radius * self.outward
    }
}

/// Where a skirt can be laid.
pub(crate) struct Ground {
    stations: Vec<Station>,
    part: SegmentIndex,
    turns: usize,
    /// From the hull to the innermost turn, mm.
    inner: f64,
    width: f64,
}

impl Ground {
    /// Round a cycle: as asked for, or as the bed has room; `None` where it has none.
    pub(crate) fn new(cycle: &ClosedCurve, skirt: &Skirt, width: f64) -> Option<Self> {
        let stations = stations(&hull(cycle.points()), width);
        if stations.is_empty() {
            return None;
        }
        let steps = (((skirt.distance - NEAREST_SKIRT) / NEARER).ceil().max(0.0) as usize).min(MOST_NEARER);
        let distances = (0..=steps).map(|k| (skirt.distance - NEARER * k as f64).max(NEAREST_SKIRT));
        let distances: Vec<f64> = distances.chain([NEAREST_SKIRT]).collect();
        let fits = |turns: usize, distance: f64| {
            let outermost = (distance + turns as f64) * width;
            skirt.bed.is_none_or(|bed| stations.iter().all(|s| is_on(&bed, s.at(outermost), 0.5 * width)))
        };
        let (turns, distance) = (1..=skirt.turns)
            .rev()
            .flat_map(|turns| distances.iter().map(move |&distance| (turns, distance)))
            .find(|&(turns, distance)| fits(turns, distance))?;
        Some(Self {
            stations,
            part: SegmentIndex::of_curves([cycle], width),
            turns,
            inner: distance * width,
            width,
        })
    }

    /// The station from which a straight way leads to a start on the cycle, clear of the rest of it; and the way's length.
    fn way(&self, start: DVec2) -> Option<(usize, f64)> {
        let distance = |k: usize| self.stations[k].at(self.inner).distance(start);
        let mut nearest: Vec<usize> = (0..self.stations.len()).collect();
        let count = WAYS.min(nearest.len());
        if count < nearest.len() {
            nearest
                .select_nth_unstable_by(count, |&a, &b| distance(a).total_cmp(&distance(b)).then(a.cmp(&b)));
        }
        nearest.truncate(count);
        nearest.sort_by(|&a, &b| distance(a).total_cmp(&distance(b)).then(a.cmp(&b)));
        let found = nearest.into_iter().find(|&k| self.is_clear(start, self.stations[k].at(self.inner)))?;
        Some((found, distance(found)))
    }

    /// How far a start on the cycle is from the skirt, mm, if there is a way.
    pub(crate) fn distance(&self, start: DVec2) -> Option<f64> {
        self.way(start).map(|(_, length)| length)
    }

    fn is_clear(&self, start: DVec2, end: DVec2) -> bool {
        let way = Segment::new(start, end);
        let length = way.length();
        // Rounded, the start may lie on the far side of its own stretch.
        let left = Segment::new(way.point_at((BESIDE * self.width / length).min(1.0)), end);
        let mut crosses = false;
        self.part.for_each_near(left, 0.0, |_, stretch| crosses |= stretch.crosses(&left));
        let (leaves, off) = (LEAVES.0 * self.width, LEAVES.1 * self.width);
        let count = ((length - leaves) / off).ceil().clamp(1.0, 1e4) as usize;
        let far = |k: usize| leaves + (length - leaves) * k as f64 / count as f64;
        !crosses
            && length > leaves
            && (0..=count).all(|k| !self.part.is_within(way.point_at(far(k) / length), off))
    }

    /// Where the skirt begins, its moves with the way to a start on the cycle, and what they are; `None` where there is no way.
    pub(crate) fn moves(&self, start: DVec2, grid: f64) -> Option<(DVec2, Vec<Move>, SkirtLaid)> {
        let (last, _) = self.way(start)?;
        let n = self.stations.len();
        let ring: Vec<Station> = (0..=n).map(|k| self.stations[(last + k) % n]).collect();
        let mut arcs = vec![0.0];
        for pair in ring.windows(2) {
            arcs.push(arcs[arcs.len() - 1] + pair[0].at(self.inner).distance(pair[1].at(self.inner)));
        }
        let round = arcs[n].max(f64::MIN_POSITIVE);
        let mut points: Vec<DVec2> = Vec::with_capacity(n * self.turns + 2);
        for turn in 0..self.turns {
            for (station, arc) in ring.iter().zip(&arcs).skip(usize::from(turn > 0)) {
                let left = (self.turns - turn) as f64 - arc / round;
                points.push(on_grid(station.at(self.inner + left * self.width), grid));
            }
        }
        points.push(start);
        points.dedup();
        let length = points.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        let laid = SkirtLaid { turns: self.turns, distance: self.inner, length };
        let moves = points.iter().skip(1).map(|&to| Move { to, role: Role::Skirt }).collect();
        Some((*points.first()?, moves, laid))
    }
}

/// Whether a bead's end of this radius lies on the bed.
fn is_on(bed: &Bed, p: DVec2, radius: f64) -> bool {
    match *bed {
        Bed::Rectangle { low, high } => {
            (p - radius).cmpge(DVec2::from(low)).all() && (p + radius).cmple(DVec2::from(high)).all()
        }
        Bed::Disc { middle, radius: reach } => p.distance(middle.into()) + radius <= reach,
    }
}

/// The convex hull of points, counter-clockwise (Andrew's monotone chain); empty where they lie in a line.
fn hull(points: &[DVec2]) -> Vec<DVec2> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let half = |points: &mut dyn Iterator<Item = DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for p in points {
            while let [.., a, b] = chain[..] {
                if (b - a).perp_dot(p - b) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut sorted.iter().copied());
    hull.extend(half(&mut sorted.iter().rev().copied()));
    if hull.len() < 3 { Vec::new() } else { hull }
}

/// Places all along a hull: on its sides with their normal, and at its corners with those between the two.
fn stations(hull: &[DVec2], width: f64) -> Vec<Station> {
    let n = hull.len();
    let mut stations = Vec::new();
    let outward = |k: usize| -(hull[(k + 1) % n] - hull[k % n]).perp().normalize_or_zero();
    for (k, &base) in hull.iter().enumerate() {
        let (before, along) = (outward(k + n - 1), outward(k));
        let turn = before.angle_to(along).max(0.0);
        let steps = (turn / CORNER).ceil().clamp(1.0, 60.0) as usize;
        stations.extend((0..steps).map(|s| Station {
            base,
            outward: DVec2::from_angle(turn * s as f64 / steps as f64).rotate(before),
        }));
        let side = hull[(k + 1) % n] - base;
        let pieces = (side.length() / (SIDE * width)).ceil().clamp(1.0, 1e4) as usize;
        stations.extend(
            (0..pieces).map(|s| Station { base: base + side * (s as f64 / pieces as f64), outward: along }),
        );
    }
    stations
}
