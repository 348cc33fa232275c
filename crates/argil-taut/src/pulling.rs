//! Points move towards the chord of their neighbours, one at a time.

use argil_curve::{ClosedCurve, DVec2, Segment, SegmentIndex};

use crate::TautOptions;
use crate::clearing::{Clearing, Surroundings};
use crate::holding::Holding;

/// Shares of the way to the chord that are tried in turn.
const SHARES: [f64; 3] = [1.0, 0.5, 0.2];

/// The longest single move, in w.
const STRIDE: f64 = 0.25;

/// How much more it counts that a point should be clear of others than that the path should be short.
const PUSH: f64 = 2.0;

/// A move shorter than this is not worth its check, in w.
const LEAST: f64 = 0.004;

/// The sharpest turn that a move may make, degrees.
const TURN: f64 = 100.0;

/// A closed path with slack in it.
#[derive(Clone, Copy)]
pub struct SlackPath<'a> {
    /// Vertices, mm; the last is joined to the first.
    pub points: &'a [DVec2],
    /// Vertices that stay, such as those of walls. Two in a row make a stretch of wall.
    pub fixed: &'a [bool],
    /// What the path has to hold.
    pub above: Option<&'a ClosedCurve>,
    /// Points of `above` that must be held by themselves, such as where it begins.
    pub starts: &'a [DVec2],
    /// The walls of the layer, all of which the path follows.
    pub walls: &'a SegmentIndex,
    /// A distance from what lies further down, mm: below zero it may not fall further.
    pub clear_of: Option<&'a dyn Fn(DVec2) -> f64>,
    /// Which vertices that distance concerns.
    pub felt: &'a [bool],
}

impl std::fmt::Debug for SlackPath<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SlackPath").field("points", &self.points.len()).finish_non_exhaustive()
    }
}

/// The path with its free points moved so that it is shorter, or clear of others, and holds what it held.
///
/// - Fixed points keep every bit.
/// - Stretches of `above` that hang are no longer than `used` of `along`, or not longer than before; a start that was held
///   is held. What holds less than three samples in a row, of 64 for each `along`, counts for nothing.
/// - No two stretches cross that did not before, and free ones come no nearer to each other and to walls than `apart` and
///   `off`, unless they were nearer before, lie within 2 w of each other along the path, or within `root` of their root.
/// - No free point turns by more than 100° that did not before.
///
/// The result depends on nothing but the arguments. Options or points that are not finite, and paths of less than four
/// points, are given back as they are.
///
/// # Complexity
/// O(sweeps · n · k) for n free points and k samples and strands within a bead of one. 100 free points take about 2 ms.
#[must_use]
pub fn pulled_taut(path: &SlackPath<'_>, options: &TautOptions) -> Vec<DVec2> {
    let mut points = path.points.to_vec();
    let n = points.len();
    let usable = options.is_usable()
        && path.fixed.len() == n
        && path.felt.len() == n
        && points.iter().all(|p| p.is_finite());
    let free: Vec<usize> = (0..n).filter(|&k| usable && n > 3 && !path.fixed[k]).collect();
    if free.is_empty() {
        return points;
    }
    let is_free_edge = |k: usize| !path.fixed[k] || !path.fixed[(k + 1) % n];
    let edge_of: Vec<u32> = (0..n).filter(|&k| is_free_edge(k)).map(|k| k as u32).collect();
    let edge = |points: &[DVec2], k: usize| Segment::new(points[k], points[(k + 1) % n]);
    let mut holding = path.above.map(|above| Holding::new(above, path.walls, path.starts, options));
    if let Some(holding) = &mut holding {
        edge_of.iter().for_each(|&k| holding.add(edge(&points, k as usize)));
    }
    let mut restless = vec![true; n];
    let mut around = Surroundings::default();
    for sweep in 0..options.sweeps {
        let edges = SegmentIndex::new(
            edge_of.iter().map(|&k| edge(&points, k as usize)).collect(),
            options.apart.max(0.5) * options.width,
        );
        let (arcs, length) = arcs(&points);
        let clearing = Clearing {
            arcs: &arcs,
            length,
            turn: 2.0 * options.width,
            walls: path.walls,
            edges: &edges,
            edge_of: &edge_of,
            apart: options.apart * options.width,
            off: options.off * options.width,
            moved: STRIDE * options.width,
        };
        let rooted = rooted(&points, path.fixed, options.root * options.width);
        let mut moved = false;
        for at in 0..free.len() {
            let k = free[if sweep % 2 == 0 { at } else { free.len() - 1 - at }];
            if !std::mem::take(&mut restless[k]) {
                continue;
            }
            let (before, after) = ((k + n - 1) % n, (k + 1) % n);
            let chord = points[before].midpoint(points[after]) - points[k];
            clearing.look_round(&points, k, &mut around);
            let is_rooted = rooted[before] || rooted[k];
            let push = if is_rooted { DVec2::ZERO } else { clearing.push(&points, k, &around) };
            let pull = (chord + PUSH * push).clamp_length_max(STRIDE * options.width);
            for share in SHARES {
                let to = points[k] + share * pull;
                if share * pull.length() < LEAST * options.width {
                    break;
                }
                let sinks = |clear_of: &dyn Fn(DVec2) -> f64| {
                    let there = clear_of(to);
                    there < 0.0 && there < clear_of(points[k])
                };
                if turns_too_sharply(&points, k, to, path.fixed)
                    || !clearing.allows(&points, (k, to), [rooted[before], rooted[k]], &around)
                    || path.clear_of.filter(|_| path.felt[k]).is_some_and(sinks)
                {
                    continue;
                }
                let old = [edge(&points, before), edge(&points, k)];
                let new = [Segment::new(points[before], to), Segment::new(to, points[after])];
                if holding.as_mut().is_none_or(|holding| holding.exchange(old, new)) {
                    points[k] = to;
                    moved = true;
                    for d in n - 2..=n + 2 {
                        restless[(k + d) % n] = true;
                    }
                    break;
                }
            }
        }
        if !moved {
            break;
        }
    }
    points
}

/// Arc length of every point, and of the whole.
fn arcs(points: &[DVec2]) -> (Vec<f64>, f64) {
    let mut arc = 0.0;
    let arcs = (0..points.len())
        .map(|k| {
            let here = arc;
            arc += points[k].distance(points[(k + 1) % points.len()]);
            here
        })
        .collect();
    (arcs, arc)
}

/// Whether an edge, named by its first vertex, lies within a length of where its excursion leaves the wall.
fn rooted(points: &[DVec2], fixed: &[bool], reach: f64) -> Vec<bool> {
    let n = points.len();
    let mut rooted = vec![false; n];
    for forward in [true, false] {
        let mut way = f64::INFINITY;
        for turn in 0..2 * n {
            let k = if forward { turn % n } else { n - 1 - turn % n };
            let (from, to) = if forward { (k, (k + 1) % n) } else { ((k + 1) % n, k) };
            if fixed[from] {
                way = 0.0;
            }
            rooted[k] |= way < reach;
            way += points[from].distance(points[to]);
        }
    }
    rooted
}

/// Whether a move makes a turn at its point or beside it sharper than allowed and than it was.
fn turns_too_sharply(points: &[DVec2], k: usize, to: DVec2, fixed: &[bool]) -> bool {
    let n = points.len();
    let moved = |j: usize| if j == k { to } else { points[j] };
    let turn = |at: &dyn Fn(usize) -> DVec2, j: usize| {
        let (a, b, c) = (at((j + n - 1) % n), at(j), at((j + 1) % n));
        (b - a).angle_to(c - b).abs().to_degrees()
    };
    [(k + n - 1) % n, k, (k + 1) % n].into_iter().filter(|&j| !fixed[j]).any(|j| {
        let now = turn(&moved, j);
        now > TURN && now > turn(&|j| points[j], j) + 1e-6
    })
}
