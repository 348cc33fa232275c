//! The path of a layer, cut short enough for its height to be told point by point.

use argil_curve::{DVec2, Segment, SegmentIndex, on_grid};
use argil_strand::{Move, Rise};

/// Stretches longer than this are cut, in w: along them the height may change by more than can be told by their ends.
const LONGEST: f64 = 2.0;

/// How near another stretch of the same layer may pass a cut, in steps of the grid: nearer, and rounding the cut could make the
/// two cross.
const TOUCHING: f64 = 10.0;

/// Pieces of a stretch are put together again where bead and z depart by no more than this share of the layer's height.
const SAME: f64 = 0.02;

/// The most pieces that a stretch is cut into.
const MOST_PIECES: f64 = 1e4;

/// The path of a layer, from the end of the layer below: points, the way to each, and the move that ends in it or is cut by it.
pub(super) struct Track {
    pub(super) points: Vec<DVec2>,
    pub(super) arcs: Vec<f64>,
    of: Vec<usize>,
}

impl Track {
    /// The moves that follow `from`, cut on the grid.
    pub(super) fn new(from: DVec2, moves: &[Move], width: f64, grid: f64) -> Self {
        let begins = std::iter::once(from).chain(moves.iter().map(|step| step.to));
        let whole: Vec<Segment> =
            begins.zip(moves).map(|(begin, step)| Segment::new(begin, step.to)).collect();
        let index = SegmentIndex::new(whole.clone(), width);
        let is_free = |p: DVec2, own: usize| {
            let mut free = true;
            index.for_each_near(Segment::new(p, p), TOUCHING * grid, |k, other| {
                free &= k == own || other.distance(p) > TOUCHING * grid;
            });
            free
        };
        let mut track = Self { points: vec![from], arcs: vec![0.0], of: vec![0] };
        for (k, stretch) in whole.iter().enumerate() {
            let pieces = (stretch.length() / (LONGEST * width)).ceil().clamp(1.0, MOST_PIECES);
            let inner = (1..pieces as usize).map(|n| on_grid(stretch.point_at(n as f64 / pieces), grid));
            inner.filter(|&p| is_free(p, k)).for_each(|p| track.push(p, k));
            track.push(stretch.end, k);
        }
        track
    }

    fn push(&mut self, to: DVec2, of: usize) {
        let last = self.points.len() - 1;
        self.arcs.push(self.arcs[last] + self.points[last].distance(to));
        self.points.push(to);
        self.of.push(of);
    }

    /// Length, mm.
    pub(super) fn length(&self) -> f64 {
        self.arcs.last().copied().unwrap_or_default()
    }

    /// The stretches between neighbouring points.
    pub(super) fn stretches(&self) -> impl Iterator<Item = Segment> + '_ {
        self.points.windows(2).map(|pair| Segment::new(pair[0], pair[1]))
    }

    /// The moves again, cut where the bead or the slope changes within one, with the rise of each. `levels` has the z of each point,
    /// `beads` the height of each stretch's bead.
    pub(super) fn moves(
        &self,
        moves: &[Move],
        levels: &[f64],
        beads: &[f64],
        height: f64,
    ) -> (Vec<Move>, Vec<Rise>) {
        let mut cut = Vec::with_capacity(moves.len());
        let mut rises = Vec::with_capacity(moves.len());
        let mut first = 1;
        while first < self.points.len() {
            let mut last = first;
            while last + 1 < self.points.len() && self.of[last + 1] == self.of[first] {
                last += 1;
            }
            let role = moves.get(self.of[first]).map(|step| step.role);
            let mean = self.mean(beads, first, last);
            let even = (first..=last).all(|k| {
                let way = (self.arcs[k] - self.arcs[first - 1])
                    / (self.arcs[last] - self.arcs[first - 1]).max(f64::MIN_POSITIVE);
                let evenly = levels[first - 1] + (levels[last] - levels[first - 1]) * way;
                (beads[k - 1] - mean).abs() <= SAME * height && (levels[k] - evenly).abs() <= SAME * height
            });
            let pieces = if even { last..=last } else { first..=last };
            for k in pieces {
                cut.extend(role.map(|role| Move { to: self.points[k], role }));
                rises.push(Rise { z: levels[k], height: if even { mean } else { beads[k - 1] } });
            }
            first = last + 1;
        }
        (cut, rises)
    }

    /// The mean bead over the stretches that end in the points from `first` to `last`, by length.
    fn mean(&self, beads: &[f64], first: usize, last: usize) -> f64 {
        let length = self.arcs[last] - self.arcs[first - 1];
        if length <= 0.0 {
            return beads[last - 1];
        }
        (first..=last).map(|k| beads[k - 1] * (self.arcs[k] - self.arcs[k - 1])).sum::<f64>() / length
    }
}
