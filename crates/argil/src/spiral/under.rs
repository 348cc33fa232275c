//! What lies below a point of a rising layer, and how high.

use argil_curve::{DVec2, Segment, SegmentIndex};

use super::track::Track;

/// Strand that is farther off than the nearest by no more than this, in w, lies below as well: what is higher counts.
const AS_NEAR: f64 = 0.05;

/// The top of a layer's strand.
pub(super) struct Under {
    index: SegmentIndex,
    /// The heights at both ends of each stretch.
    levels: Vec<[f64; 2]>,
    width: f64,
}

impl Under {
    /// Of a path with the height of each of its points.
    pub(super) fn of(track: &Track, levels: &[f64], width: f64) -> Self {
        Self::new(
            track.stretches().collect(),
            levels.windows(2).map(|pair| [pair[0], pair[1]]).collect(),
            width,
        )
    }

    /// Of the part of a path that lies within `arc` of its beginning.
    pub(super) fn of_beginning(track: &Track, levels: &[f64], arc: f64, width: f64) -> Self {
        let count = track.arcs.iter().skip(1).take_while(|&&at| at <= arc).count();
        let stretches = track.stretches().take(count).collect();
        Self::new(stretches, levels.windows(2).take(count).map(|pair| [pair[0], pair[1]]).collect(), width)
    }

    fn new(stretches: Vec<Segment>, levels: Vec<[f64; 2]>, width: f64) -> Self {
        Self { index: SegmentIndex::new(stretches, width), levels, width }
    }

    /// How high the nearest strand within `reach` mm of a place lies, and how far off it is.
    pub(super) fn top(&self, at: DVec2, reach: f64) -> Option<(f64, f64)> {
        let mut near: Vec<(f64, f64)> = Vec::new();
        self.index.for_each_near(Segment::new(at, at), reach, |k, stretch| {
            let found = stretch.nearest(at);
            if found.distance <= reach {
                let [begin, end] = self.levels[k];
                near.push((found.distance, begin + (end - begin) * found.t));
            }
        });
        let least = near.iter().map(|found| found.0).min_by(f64::total_cmp)?;
        let as_near = near.iter().filter(|found| found.0 <= least + AS_NEAR * self.width);
        as_near.map(|found| found.1).max_by(f64::total_cmp).map(|top| (top, least))
    }
}

/// Of two tops, each with how far off it is, the one that a bead lies on: the nearer, or the higher of two that are as near.
pub(super) fn higher(a: (f64, f64), b: (f64, f64), width: f64) -> (f64, f64) {
    let ((top_a, off_a), (top_b, off_b)) = (a, b);
    if (off_a - off_b).abs() <= AS_NEAR * width {
        (top_a.max(top_b), off_a.min(off_b))
    } else if off_a < off_b {
        a
    } else {
        b
    }
}
