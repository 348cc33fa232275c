//! How far the strand moves from layer to layer.
//!
//! Non-model strand exists to hold what lies above it, and is easiest to print and to break off where it lies below it
//! like a wall. So each layer's non-model strand is measured against all strand of the next layer up.

use crate::strand::Piece;
use crate::wanted::segment_index;
use argil_curve::{DVec2, Segment, SegmentIndex};

/// The non-model strand of a layer, stretch by stretch, and what the model laid beside it.
#[derive(Debug)]
pub(crate) struct Stretches {
    stretches: Vec<Stretch>,
    /// The stretches as segments, and which stretch each belongs to.
    free: SegmentIndex,
    owner: Vec<usize>,
    model: SegmentIndex,
}

#[derive(Debug)]
struct Stretch {
    /// Middles and lengths of its pieces; at least one.
    pieces: Vec<(DVec2, f64)>,
    /// It goes from one loop of wall to another: without it the layer would not be one path.
    joins: bool,
}

/// What the next layer says of a layer's non-model strand. Lengths in mm.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Coherence {
    /// Length of non-model strand, and the same times its distance from the strand above, mm².
    pub(crate) length: f64,
    pub(crate) moment: f64,
    /// Of it, what lies farther than one bead from all strand above.
    pub(crate) apart: f64,
    /// Of that, what belongs to stretches that hold nothing and join nothing.
    pub(crate) jumped: f64,
    /// Middle of each such stretch, and the length of it that lies apart.
    pub(crate) jumps: Vec<(DVec2, f64)>,
}

impl Stretches {
    /// The stretches among the pieces of a layer's paths; `loop_at` tells which loop of wall a place lies on.
    pub(crate) fn new<'a>(
        paths: impl IntoIterator<Item = &'a [Piece]>,
        loop_at: impl Fn(DVec2) -> Option<usize>,
        width: f64,
    ) -> Self {
        let mut stretches = Vec::new();
        let (mut free, mut owner, mut model) = (Vec::new(), Vec::new(), Vec::new());
        for pieces in paths {
            let mut k = 0;
            while k < pieces.len() {
                let is_free = pieces[k].is_nonmodel();
                let run = pieces[k..].iter().take_while(|p| p.is_nonmodel() == is_free).count();
                let points: Vec<DVec2> = pieces[k..k + run].iter().map(|p| p.at).collect();
                // A piece by itself is a segment without length.
                let ends = || points.windows(2).map(|e| Segment::new(e[0], e[1]));
                let alone = (points.len() == 1).then(|| Segment::new(points[0], points[0]));
                if is_free {
                    free.extend(ends().chain(alone));
                    owner.resize(free.len(), stretches.len());
                    let before = k.checked_sub(1).and_then(|b| loop_at(pieces[b].at));
                    let after = pieces.get(k + run).and_then(|p| loop_at(p.at));
                    stretches.push(Stretch {
                        pieces: pieces[k..k + run].iter().map(|p| (p.at, p.length)).collect(),
                        joins: before.is_some() && after.is_some() && before != after,
                    });
                } else {
                    model.extend(ends().chain(alone));
                }
                k += run;
            }
        }
        let cell = 0.75 * width;
        Self { stretches, free: SegmentIndex::new(free, cell), owner, model: SegmentIndex::new(model, cell) }
    }

    /// Measures the stretches against the pieces of the next layer's paths; `held` is how far a bead may lie beside
    /// the one below it, mm.
    ///
    /// # Complexity
    /// Near linear in the pieces of both layers.
    pub(crate) fn against<'a>(
        &self,
        above: impl IntoIterator<Item = &'a [Piece]> + Clone,
        lines: impl IntoIterator<Item = &'a [DVec2]>,
        held: f64,
        width: f64,
    ) -> Coherence {
        let mut holds: Vec<bool> = self.stretches.iter().map(|s| s.joins).collect();
        for piece in above.into_iter().flatten() {
            if !self.model.is_within(piece.at, held)
                && let Some(nearest) = self.free.nearest_within(piece.at, held)
            {
                holds[self.owner[nearest.index]] = true;
            }
        }
        let above = segment_index(lines, width);
        let mut coherence = Coherence::default();
        for (stretch, holds) in self.stretches.iter().zip(holds) {
            let mut apart = 0.0;
            for &(at, length) in &stretch.pieces {
                let distance = above.distance(at);
                coherence.length += length;
                coherence.moment += length * distance;
                apart += if distance > width { length } else { 0.0 };
            }
            coherence.apart += apart;
            if apart > 0.0 && !holds {
                coherence.jumped += apart;
                coherence.jumps.push((stretch.pieces[stretch.pieces.len() / 2].0, apart));
            }
        }
        coherence
    }
}
