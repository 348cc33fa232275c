//! Rings into as few closed curves as short joints allow.

use argil_curve::{DVec2, Segment, SegmentIndex};

use crate::joint::{Candidate, Cut, Joint, Search, shorter_way};
use crate::ring::{Ring, Track};
use crate::trace::traced;
use crate::{FillCurve, FillError, FillOptions};

/// Curves and the joints that made them.
#[derive(Clone, Debug, PartialEq)]
pub struct Merged {
    /// The curves, each with one role a segment.
    pub curves: Vec<FillCurve>,
    /// The joints, in the order in which they were made: the best first.
    pub joints: Vec<Joint>,
}

/// Merges rings into as few closed curves as joints of at most [`FillOptions::reach`] allow.
///
/// Candidates for joints are scored by how straight and parallel they lie, and taken in the order of their score
/// as long as they join what is not joined yet (Kruskal): a spanning tree of the rings. A joint between rings of a fill is an H,
/// two parallel legs one bead apart, so that the strand is as long as before and lies one bead from itself. At a wall
/// it is a V with its point on the wall, between two walls a slit, so that the walls stay whole but for
/// [`FillOptions::wall_cut`]. Joints keep away from the places in `avoid`, such as the joints of the layer below, where they can.
///
/// Vertices of the rings stay as they are, bit by bit, except for those that are cut out.
///
/// # Errors
/// [`FillError::Option`] and [`FillError::Ring`].
///
/// # Complexity
/// O(places tried · log n) for n segments; at most 64 places for a pair of neighbours, all places every
/// fifth of a bead for those that are left.
///
/// # Example
/// ```
/// use argil_curve::DVec2;
/// use argil_fill::{FillOptions, Ring, merge};
/// let square = |half: f64| [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|c| half * DVec2::from(c)).to_vec();
/// let walls = [Ring { points: square(9.25), wall: Some(0) }, Ring { points: square(7.75), wall: Some(1) }];
/// let merged = merge(&walls, &FillOptions::for_width(1.5), &[])?;
/// assert_eq!((merged.curves.len(), merged.joints.len()), (1, 1));
/// # Ok::<(), argil_fill::FillError>(())
/// ```
pub fn merge(rings: &[Ring], options: &FillOptions, avoid: &[DVec2]) -> Result<Merged, FillError> {
    options.check()?;
    let tracks = rings
        .iter()
        .enumerate()
        .map(|(number, ring)| Track::new(number, ring, options.width))
        .collect::<Result<Vec<_>, _>>()?;
    let mut tree = Tree::new(&tracks, options);
    for tier in TIERS {
        if tree.parts == 1 {
            break;
        }
        tree.grow(tier, avoid);
    }
    let curves = traced(&tracks, &tree.taken, options.grid);
    let joints = tree
        .taken
        .iter()
        .map(|c| Joint { rings: c.tracks, legs: c.legs.map(|leg| [leg.start, leg.end]) })
        .collect();
    Ok(Merged { curves, joints })
}

/// How narrow and how closely spaced joints may be.
#[derive(Clone, Copy, Debug)]
struct Tier {
    /// What a joint takes out of a ring, in w.
    cut: f64,
    /// Distance between two cuts of the same ring, in w.
    margin: f64,
    /// Distance of legs from other legs and rings, in w.
    apart: f64,
    /// Places that are tried on a pair of rings.
    samples: usize,
}

/// First few places, which do for nearly all rings; then all, and narrower joints for tiny rings and crowded places.
const TIERS: [Tier; 5] = [
    Tier { cut: 1.0, margin: 0.5, apart: 0.2, samples: 64 },
    Tier { cut: 1.0, margin: 0.5, apart: 0.2, samples: 100_000 },
    Tier { cut: 0.7, margin: 0.3, apart: 0.05, samples: 100_000 },
    Tier { cut: 0.45, margin: 0.1, apart: 0.05, samples: 100_000 },
    Tier { cut: 0.25, margin: 0.05, apart: 0.03, samples: 100_000 },
];

/// Legs are looked at without this share of their ends, which lie on the rings that they join.
const ENDS: f64 = 0.02;

/// The tree of joints as it grows.
struct Tree<'a> {
    tracks: &'a [Track],
    options: &'a FillOptions,
    /// Pairs of tracks that may come near each other, the shorter one first.
    pairs: Vec<[usize; 2]>,
    /// All segments of all tracks, and whose they are.
    index: SegmentIndex,
    owner: Vec<usize>,
    /// Union-find: towards the root of each track's part.
    root: Vec<usize>,
    parts: usize,
    cuts: Vec<Vec<Cut>>,
    taken: Vec<Candidate>,
}

impl<'a> Tree<'a> {
    fn new(tracks: &'a [Track], options: &'a FillOptions) -> Self {
        let reach = options.reach * options.width;
        let mut pairs = Vec::new();
        for a in 0..tracks.len() {
            for b in a + 1..tracks.len() {
                if tracks[a].may_reach(&tracks[b], reach) {
                    let first_longer = tracks[a].curve.length() > tracks[b].curve.length();
                    pairs.push(if first_longer { [b, a] } else { [a, b] });
                }
            }
        }
        let index = SegmentIndex::of_curves(tracks.iter().map(|track| &track.curve), options.width);
        let owner = tracks
            .iter()
            .enumerate()
            .flat_map(|(k, t)| std::iter::repeat_n(k, t.curve.segment_count()))
            .collect();
        Self {
            tracks,
            options,
            pairs,
            index,
            owner,
            root: (0..tracks.len()).collect(),
            parts: tracks.len(),
            cuts: vec![Vec::new(); tracks.len()],
            taken: Vec::new(),
        }
    }

    fn part(&mut self, mut track: usize) -> usize {
        while self.root[track] != track {
            self.root[track] = self.root[self.root[track]];
            track = self.root[track];
        }
        track
    }

    /// Takes the best joints of a tier between parts that are still apart.
    fn grow(&mut self, tier: Tier, avoid: &[DVec2]) {
        let w = self.options.width;
        let search = Search {
            width: w,
            cut: tier.cut * w,
            wall_cut: self.options.wall_cut * w,
            reach: self.options.reach * w,
            samples: tier.samples,
            avoid,
        };
        let mut candidates = Vec::new();
        for pair in 0..self.pairs.len() {
            let [a, b] = self.pairs[pair];
            if self.part(a) != self.part(b) {
                search.between([a, b], &self.tracks[a], &self.tracks[b], &mut candidates);
            }
        }
        candidates.sort_by(|a, b| a.score.total_cmp(&b.score));
        for candidate in candidates {
            let [a, b] = candidate.tracks.map(|track| self.part(track));
            if a == b || !self.fits(&candidate, tier) {
                continue;
            }
            self.root[a] = b;
            self.parts -= 1;
            for (track, cut) in candidate.tracks.into_iter().zip(candidate.cuts) {
                self.cuts[track].push(cut);
            }
            self.taken.push(candidate);
        }
    }

    fn fits(&self, candidate: &Candidate, tier: Tier) -> bool {
        let w = self.options.width;
        let free = |track: usize, cut: Cut| {
            let length = self.tracks[track].curve.length();
            let margin = (tier.margin * w).min(0.08 * length);
            self.cuts[track].iter().all(|other| {
                let gap = shorter_way(0.5 * (cut.low + cut.high - other.low - other.high), length).abs();
                gap >= 0.5 * (cut.high - cut.low + other.high - other.low) + margin
            })
        };
        let [first, second] = candidate.legs;
        candidate.tracks.into_iter().zip(candidate.cuts).all(|(track, cut)| free(track, cut))
            && !shortened(first).crosses(&shortened(second))
            && candidate.legs.iter().all(|leg| self.is_clear(*leg, candidate.tracks, tier.apart * w))
    }

    /// Whether a leg crosses no ring and keeps away from all other legs, and from rings that it does not join.
    fn is_clear(&self, leg: Segment, joins: [usize; 2], apart: f64) -> bool {
        let inner = shortened(leg);
        let mut clear = true;
        self.index.for_each_near(inner, apart, |segment, side| {
            let joined = joins.contains(&self.owner[segment]);
            clear &= if joined { !inner.crosses(&side) } else { inner.distance_to(&side) >= apart };
        });
        clear && self.taken.iter().flat_map(|c| c.legs).all(|other| inner.distance_to(&other) >= apart)
    }
}

fn shortened(leg: Segment) -> Segment {
    Segment::new(leg.point_at(ENDS), leg.point_at(1.0 - ENDS))
}
