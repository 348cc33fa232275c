//! A tree of joints: the best ones that join what is not yet joined.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use argil_curve::{DVec2, NearestSegment, Segment, SegmentIndex};

use crate::FillOptions;
use crate::joint::{Candidate, Cut, Search, Sketch, shorter_way};
use crate::ring::Track;

/// How narrow and how closely spaced joints may be.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tier {
    /// What a joint takes out of a ring, in w.
    pub(crate) cut: f64,
    /// Distance between two cuts of the same ring, in w.
    pub(crate) margin: f64,
    /// Distance of legs from other legs and rings, in w.
    pub(crate) apart: f64,
    /// The longest joint, in w, if the options allow it.
    pub(crate) reach: f64,
    /// Distance of the places that are tried on a ring, in w, and how many at most.
    pub(crate) step: f64,
    pub(crate) samples: usize,
}

/// Legs are looked at without this share of their ends, which lie on the rings that they join.
const ENDS: f64 = 0.02;

/// A joint that may be the next one: a bound of its score, or the score itself once its legs are drawn.
struct Open {
    score: f64,
    /// The number of its sketch, which decides among equals.
    sketch: usize,
    /// The number of the candidate, once it is drawn.
    drawn: Option<usize>,
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
        other.score.total_cmp(&self.score).then(other.sketch.cmp(&self.sketch))
    }
}

/// What joints must not cross, and the first of the rings to which that applies.
pub(crate) struct Fence {
    pub(crate) index: SegmentIndex,
    pub(crate) first: usize,
}

/// The tree of joints as it grows.
pub(crate) struct Tree<'a> {
    tracks: &'a [Track],
    options: &'a FillOptions,
    fence: Option<&'a Fence>,
    /// All segments of all tracks, and whose they are.
    index: SegmentIndex,
    owner: Vec<usize>,
    /// The number of each track's first segment in the index.
    first_segment: Vec<usize>,
    /// Union-find: towards the root of each track's part.
    root: Vec<usize>,
    parts: usize,
    cuts: Vec<Vec<Cut>>,
    taken: Vec<Candidate>,
}

impl<'a> Tree<'a> {
    pub(crate) fn new(tracks: &'a [Track], options: &'a FillOptions, fence: Option<&'a Fence>) -> Self {
        // A query of the first tier then looks at few cells.
        let cell = 1.5 * options.width;
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
            fence,
            index,
            owner,
            first_segment,
            root: (0..tracks.len()).collect(),
            parts: tracks.len(),
            cuts: vec![Vec::new(); tracks.len()],
            taken: Vec::new(),
        }
    }

    /// The joints so far, the best first.
    pub(crate) fn joints(&self) -> &[Candidate] {
        &self.taken
    }

    fn part(&self, mut track: usize) -> usize {
        while self.root[track] != track {
            track = self.root[track];
        }
        track
    }

    /// Takes the best joints of a tier between parts that are still apart.
    pub(crate) fn grow(&mut self, tier: Tier, avoid: &[DVec2]) {
        if self.parts == 1 {
            return;
        }
        let w = self.options.width;
        let search = Search {
            width: w,
            cut: tier.cut * w,
            wall_cut: self.options.wall_cut * w,
            reach: self.options.reach.min(tier.reach) * w,
            step: tier.step * w,
            samples: tier.samples,
            avoid,
        };
        let sketches = self.sketches(&search);
        // The legs of a joint are drawn only when no other can be better.
        let mut open: BinaryHeap<Open> = (0..sketches.len())
            .map(|sketch| Open { score: sketches[sketch].bound, sketch, drawn: None })
            .collect();
        let mut candidates: Vec<Candidate> = Vec::new();
        while let Some(Open { score, sketch, drawn }) = open.pop() {
            let [a, b] = sketches[sketch].tracks.map(|track| self.part(track));
            if a == b {
                continue;
            }
            let Some(drawn) = drawn else {
                let [first, second] = sketches[sketch].tracks.map(|track| &self.tracks[track]);
                if let Some(candidate) = search.candidate(&sketches[sketch], first, second) {
                    let score = score.max(candidate.score);
                    open.push(Open { score, sketch, drawn: Some(candidates.len()) });
                    candidates.push(candidate);
                }
                continue;
            };
            let candidate = candidates[drawn];
            if !self.fits(&candidate, tier) {
                continue;
            }
            // The larger number hangs under the smaller: paths stay short, since rings are joined to their neighbours.
            self.root[a.max(b)] = a.min(b);
            self.parts -= 1;
            for (track, cut) in candidate.tracks.into_iter().zip(candidate.cuts) {
                self.cuts[track].push(cut);
            }
            self.taken.push(candidate);
        }
    }

    /// Where tracks could be joined to others that are no shorter and not yet joined to them.
    fn sketches(&self, search: &Search<'_>) -> Vec<Sketch> {
        let parts: Vec<usize> = (0..self.tracks.len()).map(|track| self.part(track)).collect();
        let mut sketches = Vec::new();
        for (track, own) in self.tracks.iter().enumerate() {
            let reaches = |other: &usize| {
                parts[*other] != parts[track]
                    && self.is_longer(*other, track)
                    && own.may_reach(&self.tracks[*other], search.reach)
            };
            if (0..self.tracks.len()).any(|other| reaches(&other)) {
                self.sketch(track, &parts, search, &mut sketches);
            }
        }
        sketches
    }

    /// Whether a track is longer than another one, or as long and after it: from the other to it joints are looked for.
    fn is_longer(&self, track: usize, other: usize) -> bool {
        let [own, others] = [track, other].map(|track| self.tracks[track].curve.length());
        own > others || (own == others && track > other)
    }

    fn sketch(&self, track: usize, parts: &[usize], search: &Search<'_>, sketches: &mut Vec<Sketch>) {
        let own = &self.tracks[track];
        let length = own.curve.length();
        let count = search.count(own);
        // The nearest place of each other track.
        let mut near: Vec<(usize, NearestSegment)> = Vec::new();
        for k in 0..count {
            let from = own.place((k as f64 + 0.5) * length / count as f64);
            let spot = Segment::new(from.at, from.at);
            near.clear();
            self.index.for_each_near(spot, search.reach, |index, segment| {
                let other = self.owner[index];
                if parts[other] == parts[track] || boxes_apart(&spot, &segment, search.reach) {
                    return;
                }
                if !self.is_longer(other, track) {
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
            sketches.extend(near.iter().filter_map(|&(other, nearest)| {
                let to =
                    self.tracks[other].place_on(nearest.index - self.first_segment[other], nearest.point);
                search.sketch([track, other], own, [from, to])
            }));
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
            && candidate.legs.iter().all(|leg| {
                self.is_inside(*leg, candidate.tracks)
                    && self.is_clear(*leg, candidate.tracks, tier.apart * w)
            })
    }

    /// Whether a leg crosses no fence.
    fn is_inside(&self, leg: Segment, joins: [usize; 2]) -> bool {
        let mut inside = true;
        if let Some(fence) = self.fence.filter(|fence| joins.iter().all(|&track| track >= fence.first)) {
            fence.index.for_each_near(leg, 0.0, |_, side| inside &= !leg.crosses(&side));
        }
        inside
    }

    /// Whether a leg crosses no ring and keeps away from all other legs, and from rings that it does not join.
    fn is_clear(&self, leg: Segment, joins: [usize; 2], apart: f64) -> bool {
        let inner = shortened(leg);
        let touching = 2.0 * self.options.grid;
        let mut clear = true;
        self.index.for_each_near(leg, apart, |segment, side| {
            clear &= if joins.contains(&self.owner[segment]) {
                // A tip lies on its ring, up to rounding.
                let touches = || [leg.start, leg.end].iter().any(|&tip| side.is_within(tip, touching));
                // Nor does it run along its ring, where rounding makes a touch a crossing.
                (!leg.crosses(&side) || touches()) && keeps_apart(&inner, &side, touching)
            } else {
                keeps_apart(&inner, &side, apart)
            };
        });
        clear && self.taken.iter().flat_map(|c| c.legs).all(|other| keeps_apart(&inner, &other, apart))
    }
}

fn shortened(leg: Segment) -> Segment {
    Segment::new(leg.point_at(ENDS), leg.point_at(1.0 - ENDS))
}

/// Whether the boxes round two segments are farther than `distance` from each other along an axis.
fn boxes_apart(a: &Segment, b: &Segment, distance: f64) -> bool {
    let beyond = |low: DVec2, high: DVec2| (low - high).cmpgt(DVec2::splat(distance)).any();
    beyond(a.start.min(a.end), b.start.max(b.end)) || beyond(b.start.min(b.end), a.start.max(a.end))
}

fn keeps_apart(a: &Segment, b: &Segment, distance: f64) -> bool {
    boxes_apart(a, b, distance) || a.distance_to(b) >= distance
}
