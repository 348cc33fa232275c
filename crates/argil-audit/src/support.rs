//! What hangs in the air: stretches with no bead near enough below them.

use crate::cycle::Path;
use crate::sampling::{Run, runs};
use crate::strand::Piece;
use crate::wanted::segment_index;
use argil_curve::{DVec2, Segment, SegmentIndex};

/// In layer heights: strand farther below than this holds nothing. Where layers rise, a bead may be half as high again as a layer; a
/// tenth is for heights that are sampled.
const DEEPEST: f64 = 1.6;

/// The strand of a layer as the next one finds it.
#[derive(Debug)]
pub(crate) struct Beads {
    pub(crate) index: SegmentIndex,
    /// Height of the nozzle at both ends of each segment, mm.
    heights: Vec<[f64; 2]>,
    /// How far down it holds what lies on it, mm.
    deepest: f64,
}

impl Beads {
    pub(crate) fn new(paths: &[Path], width: f64, layer_height: f64) -> Self {
        let heights = paths.iter().flat_map(|path| {
            let segments = path.points.windows(2).zip(path.heights.windows(2));
            segments.filter(|(ends, _)| ends[0] != ends[1]).map(|(_, heights)| [heights[0], heights[1]])
        });
        Self {
            index: segment_index(paths.iter().map(|path| path.points.as_slice()), width),
            heights: heights.collect(),
            deepest: DEEPEST * layer_height,
        }
    }

    /// Whether some of it lies within `across` mm of a place beside, and not too deep below.
    fn hold(&self, p: &Piece, across: f64) -> bool {
        let is_near = |k: usize, at: DVec2, segment: Segment| {
            let share = segment.start.distance(at) / segment.length().max(f64::MIN_POSITIVE);
            let [begin, end] = self.heights.get(k).copied().unwrap_or([p.z; 2]);
            p.z - (begin + (end - begin) * share) <= self.deepest
        };
        let Some(nearest) = self.index.nearest_within(p.at, across) else { return false };
        let Some(&segment) = self.index.segments().get(nearest.index) else { return false };
        if is_near(nearest.index, nearest.point, segment) {
            return true;
        }
        let mut held = false;
        self.index.for_each_near(Segment::new(p.at, p.at), across, |k, segment| {
            let found = segment.nearest(p.at);
            held |= found.distance <= across && is_near(k, found.point, segment);
        });
        held
    }
}

/// Middle and length of each stretch longer than `bridge` mm with nothing of `below` within `across` mm, or only what lies much
/// deeper than a layer.
///
/// The first `step_up` mm of the path are the step from the layer below: it is a run of its own, and what
/// follows is a cycle when `cyclic`. This is the continuous criterion (every maximal run of points not held
/// is at most `ε_along`); the paper's Eq. 1 tests samples `ε_along` apart and lets gaps of twice that pass.
pub(crate) fn hanging(
    pieces: &[Piece],
    below: &Beads,
    across: f64,
    bridge: f64,
    step_up: f64,
    cyclic: bool,
) -> Vec<(DVec2, f64)> {
    let bare: Vec<bool> = pieces.iter().map(|p| !below.hold(p, across)).collect();
    let mut run = 0.0;
    let cut = pieces
        .iter()
        .position(|p| {
            run += p.length;
            run >= step_up
        })
        .unwrap_or(pieces.len());
    let stretches = |first: usize, last: usize, cyclic: bool| {
        let found = runs(last - first, cyclic, |k| bare[first + k], |k| pieces[first + k].length);
        found
            .into_iter()
            .filter(|run| run.length > bridge)
            .map(move |Run { middle, length, .. }| (first + middle, length))
    };
    stretches(0, cut, false)
        .chain(stretches(cut, pieces.len(), cyclic))
        .map(|(middle, length)| (pieces[middle].at, length))
        .collect()
}
