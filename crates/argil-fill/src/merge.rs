//! Rings into as few closed curves as short joints allow.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use argil_curve::{DVec2, NearestSegment, Segment, SegmentIndex};

use crate::joint::{Candidate, Cut, Joint, Search, Sketch, shorter_way};
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
/// O(places tried · log n) for n segments; at most 32 places for a pair of neighbours, all places every
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
    for (number, tier) in TIERS.into_iter().enumerate() {
        if tree.parts == 1 {
            break;
        }
        if number == 1 {
            tree.find_neighbours();
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
    Tier { cut: 1.0, margin: 0.5, apart: 0.2, samples: 32 },
    Tier { cut: 1.0, margin: 0.5, apart: 0.2, samples: 100_000 },
    Tier { cut: 0.7, margin: 0.3, apart: 0.05, samples: 100_000 },
    Tier { cut: 0.45, margin: 0.1, apart: 0.05, samples: 100_000 },
    Tier { cut: 0.25, margin: 0.05, apart: 0.03, samples: 100_000 },
];

/// Legs are looked at without this share of their ends, which lie on the rings that they join.
const ENDS: f64 = 0.02;

/// A joint that may be the next one: a bound of its score, or the score itself once its legs are drawn.
struct Open {
    score: f64,
    /// Its number, which decides among equals.
    place: usize,
    sketch: Sketch,
    candidate: Option<Candidate>,
}

impl PartialEq for Open {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Open {}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Open {
    /// The lowest score is the greatest.
    fn cmp(&self, other: &Self) -> Ordering {
        other.score.total_cmp(&self.score).then(other.place.cmp(&self.place))
    }
}

/// The tree of joints as it grows.
struct Tree<'a> {
    tracks: &'a [Track],
    options: &'a FillOptions,
    /// All segments of all tracks, and whose they are.
    index: SegmentIndex,
    owner: Vec<usize>,
    /// The number of each track's first segment in the index.
    first_segment: Vec<usize>,
    /// The tracks within reach of each track, once they are looked for.
    neighbours: Option<Vec<Vec<usize>>>,
    /// Union-find: towards the root of each track's part.
    root: Vec<usize>,
    parts: usize,
    cuts: Vec<Vec<Cut>>,
    taken: Vec<Candidate>,
}

impl<'a> Tree<'a> {
    fn new(tracks: &'a [Track], options: &'a FillOptions) -> Self {
        // A query within reach then looks at few cells.
        let cell = 1.01 * options.reach * options.width;
        let index = SegmentIndex::of_curves(tracks.iter().map(|track| &track.curve), cell);
        let owner = tracks
            .iter()
            .enumerate()
            .flat_map(|(k, t)| std::iter::repeat_n(k, t.curve.segment_count()))
            .collect();
        let mut count = 0;
        let first_segment = tracks
            .iter()
            .map(|track| {
                count += track.curve.segment_count();
                count - track.curve.segment_count()
            })
            .collect();
        Self {
            tracks,
            options,
            index,
            owner,
            first_segment,
            neighbours: None,
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
        // The legs of a joint are drawn only when no other can be better.
        let mut open = BinaryHeap::new();
        for track in 0..self.tracks.len() {
            if self.may_be_joined(track) {
                self.sketch(track, &search, &mut open);
            }
        }
        while let Some(Open { place, score, sketch, candidate }) = open.pop() {
            let [a, b] = sketch.tracks.map(|track| self.part(track));
            if a == b {
                continue;
            }
            let Some(candidate) = candidate else {
                let [first, second] = sketch.tracks.map(|track| &self.tracks[track]);
                let drawn = search.candidate(&sketch, first, second);
                open.extend(drawn.map(|c| Open {
                    place,
                    score: c.score.max(score),
                    sketch,
                    candidate: Some(c),
                }));
                continue;
            };
            if !self.fits(&candidate, tier) {
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

    /// Looks for the tracks within reach of each other, so that what is joined already is not tried everywhere.
    fn find_neighbours(&mut self) {
        let reach = self.options.reach * self.options.width;
        let mut neighbours = vec![Vec::new(); self.tracks.len()];
        for (segment, &own) in self.index.segments().iter().zip(&self.owner) {
            self.index.for_each_near(*segment, reach, |index, other| {
                let track = self.owner[index];
                let known: &mut Vec<usize> = &mut neighbours[own];
                if track != own && !known.contains(&track) && segment.distance_to(&other) <= reach {
                    known.push(track);
                }
            });
        }
        self.neighbours = Some(neighbours);
    }

    /// Whether something is near a track that it is not yet joined to, or nobody has looked.
    fn may_be_joined(&mut self, track: usize) -> bool {
        let Some(neighbours) = self.neighbours.take() else { return true };
        let own = self.part(track);
        let apart = neighbours[track].iter().any(|&other| self.part(other) != own);
        self.neighbours = Some(neighbours);
        apart
    }

    /// Adds where a track could be joined to others that are no shorter and not yet joined to it.
    fn sketch(&mut self, track: usize, search: &Search<'_>, open: &mut BinaryHeap<Open>) {
        let own = &self.tracks[track];
        let length = own.curve.length();
        let part = self.part(track);
        let count = search.count(own);
        // The nearest place of each other track.
        let mut near: Vec<(usize, NearestSegment)> = Vec::new();
        for k in 0..count {
            let from = own.place((k as f64 + 0.5) * length / count as f64);
            near.clear();
            self.index.for_each_near(Segment::new(from.at, from.at), search.reach, |index, segment| {
                let other = self.owner[index];
                let longer = self.tracks[other].curve.length();
                if longer < length || (longer == length && other <= track) {
                    return;
                }
                let nearest = segment.nearest(from.at);
                let (point, distance) = (nearest.point, nearest.distance);
                if distance > search.reach {
                    return;
                }
                let found = NearestSegment { index, point, distance };
                match near.iter_mut().find(|(known, _)| *known == other) {
                    None => near.push((other, found)),
                    Some((_, best)) => {
                        if distance < best.distance || (distance == best.distance && index < best.index) {
                            *best = found;
                        }
                    }
                }
            });
            near.sort_unstable_by_key(|(other, _)| *other);
            for &(other, nearest) in &near {
                if self.part(other) == part {
                    continue;
                }
                let to = self.tracks[other].place_on(nearest.index - self.first_segment[other], nearest.point);
                if let Some(sketch) = search.sketch([track, other], own, [from, to]) {
                    open.push(Open {
                        place: open.len(),
                        score: sketch.bound,
                        sketch,
                        candidate: None,
                    });
                }
            }
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
