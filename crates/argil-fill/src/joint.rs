//! Joints: two legs by which two rings become one.

use argil_curve::{DVec2, Segment};

use crate::ring::{Place, Track};

/// Two strands that join two rings; the stretch between them is taken out of either.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Joint {
    /// The rings that it joins, as indices into the rings that were merged.
    pub rings: [usize; 2],
    /// The legs, each from the first ring to the second, mm.
    pub legs: [[DVec2; 2]; 2],
}

impl Joint {
    /// Its middle, mm.
    #[must_use]
    pub fn middle(&self) -> DVec2 {
        0.25 * self.legs.iter().flatten().sum::<DVec2>()
    }
}

/// A stretch of a track, from `low` rising to `high`; both may lie beyond one turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cut {
    pub(crate) low: f64,
    pub(crate) high: f64,
}

/// Where a joint could be made, before its legs are drawn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sketch {
    /// No joint from here has a lower score.
    pub(crate) bound: f64,
    /// The tracks, the shorter one first.
    pub(crate) tracks: [usize; 2],
    from: Place,
    to: Place,
    /// Direction from one track to the other, and how much it leans along the first.
    across: DVec2,
    along: DVec2,
    skew: f64,
    crowd: f64,
}

/// A joint that could be made.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    pub(crate) score: f64,
    /// The tracks.
    pub(crate) tracks: [usize; 2],
    pub(crate) cuts: [Cut; 2],
    /// Whether the first leg ends at the high end of the second cut.
    pub(crate) turned: bool,
    /// From the first track to the second: first at the low end of the first cut, then at its high end.
    pub(crate) legs: [Segment; 2],
}

/// How joints are looked for at one tier.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Search<'a> {
    pub(crate) width: f64,
    /// What a joint takes out of a ring, mm.
    pub(crate) cut: f64,
    /// What it takes out of a wall, mm.
    pub(crate) wall_cut: f64,
    /// The longest joint, mm.
    pub(crate) reach: f64,
    /// Distance of the places that are tried, mm, and how many of a ring at most.
    pub(crate) step: f64,
    pub(crate) samples: usize,
    /// Places to keep away from.
    pub(crate) avoid: &'a [DVec2],
}

/// The chord that gives a ring's direction goes so far to either side, in w.
const STEP: f64 = 0.2;

/// A joint may lean against the ring that it leaves so far: the cosine of its angle with it.
const MOST_SKEW: f64 = 0.75;

/// At most this share of a ring is taken out by one joint.
const MOST_OF_RING: f64 = 0.18;

/// Joints keep this far away from those of the layer below if they can, in w.
const STAGGER: f64 = 2.0;

impl Search<'_> {
    /// How many places along a track are tried.
    pub(crate) fn count(&self, track: &Track) -> usize {
        ((track.curve.length() / self.step).ceil() as usize).clamp(12, self.samples.max(12))
    }

    /// The joint between a place on one track and the nearest one on another, if it does not lean too much.
    pub(crate) fn sketch(&self, tracks: [usize; 2], first: &Track, [from, to]: [Place; 2]) -> Option<Sketch> {
        let w = self.width;
        let axis = to.at - from.at;
        let distance = axis.length();
        let along = first.heading(from.arc, STEP * w);
        let across = if distance > 0.0 { axis / distance } else { along.perp() };
        let skew = along.dot(across).abs();
        if skew > MOST_SKEW {
            return None;
        }
        let crowd = self.avoid.iter().map(|p| 1.0 - p.distance(from.at) / (STAGGER * w)).fold(0.0, f64::max);
        let bound = 2.0 * (distance - w).abs() / w + skew + 2.0 * crowd;
        Some(Sketch { bound, tracks, from, to, across, along, skew, crowd })
    }

    /// Half of what is taken out of either track.
    fn halves(&self, first: &Track, second: &Track) -> [f64; 2] {
        let half = |track: &Track| {
            let cut = if track.wall.is_some() { self.wall_cut } else { self.cut };
            0.5 * cut.min(2.0 * MOST_OF_RING * track.curve.length())
        };
        let [a, b] = [half(first), half(second)];
        match (first.wall, second.wall) {
            // Parallel legs between two rings of a fill, a slit between two walls.
            (None, None) | (Some(_), Some(_)) => [a.min(b), a.min(b)],
            // A V with its point at the wall.
            _ => [a, b],
        }
    }

    /// The joint with its legs, if both have a place.
    pub(crate) fn candidate(&self, sketch: &Sketch, first: &Track, second: &Track) -> Option<Candidate> {
        let w = self.width;
        let [here, there] = self.halves(first, second);
        let Sketch { tracks, from, to, across, along, skew, crowd, .. } = *sketch;
        let distance = to.at.distance(from.at);
        let side = if across.perp().dot(along) < 0.0 { -across.perp() } else { across.perp() };
        let (low, high) = (first.place(from.arc - here), first.place(from.arc + here));
        let reach = self.reach + 0.3 * w;
        let near = second.nearest(to.at - there * side, reach)?;
        let far = second.nearest(to.at + there * side, reach)?;
        let legs = [Segment::new(low.at, near.at), Segment::new(high.at, far.at)];
        let span = shorter_way(far.arc - near.arc, second.curve.length());
        let taken = span.abs();
        let roomy = (0.6 * there..=(4.0 * there + 0.6 * w).min(0.7 * second.curve.length())).contains(&taken);
        if !roomy || legs.iter().any(|leg| leg.length() > reach) {
            return None;
        }
        let chords = [low.at.distance(high.at), near.at.distance(far.at)];
        let bent =
            (chords[0] - 2.0 * here).abs() + (chords[1] - 2.0 * there).abs() + (taken - chords[1]).abs();
        let uneven = (legs[0].length() - legs[1].length()).abs();
        let score = (2.0 * (distance - w).abs() + uneven + bent) / w + skew + 2.0 * crowd;
        let turned = span < 0.0;
        let other = if turned {
            Cut { low: near.arc + span, high: near.arc }
        } else {
            Cut { low: near.arc, high: near.arc + span }
        };
        let cuts = [Cut { low: from.arc - here, high: from.arc + here }, other];
        Some(Candidate { score, tracks, cuts, turned, legs })
    }
}

/// The difference of two arcs of a closed curve, the shorter way round.
pub(crate) fn shorter_way(difference: f64, length: f64) -> f64 {
    (difference + 0.5 * length).rem_euclid(length) - 0.5 * length
}
