//! Strands that run beside one another closer than one bead.

use crate::strand::Piece;
use argil_curve::DVec2;

/// A half is one also where rounding makes it more or less by so much.
const HALF: f64 = 1e-9;

/// Every which piece looks for its neighbours if there are so many pieces to a step between strands. Halves are rounded down: with the
/// default settings it is always one, two and a half, which may not come out as two or three by the last bit of the width.
pub(crate) fn stride(pieces_a_step: f64) -> usize {
    (pieces_a_step - HALF).round().max(1.0) as usize
}

/// Length of bead, in mm, that overlaps another stretch of the same path, apart from roots and where both are
/// wall.
///
/// Every `stride`-th piece looks for the nearest other one that is more than two beads away along the path;
/// where their distance d is less than w, half of (w − d)/w of the piece's length lies on the other (its
/// other half is counted there). A path counts as a cycle here, whatever its ends.
///
/// # Complexity
/// O(n log n + pairs within one bead of one another).
pub(crate) fn crowded(pieces: &[Piece], apart: &[bool], width: f64, stride: usize) -> f64 {
    let Some(last) = pieces.last() else { return 0.0 };
    let length = last.arc + 0.5 * last.length;
    let thinned: Vec<usize> = (0..pieces.len()).step_by(stride.max(1)).collect();
    let places = Places::new(thinned.iter().map(|&k| pieces[k].at), width);
    let mut crowded = 0.0;
    for &k in thinned.iter().filter(|&&k| apart[k] && !pieces[k].is_fill) {
        let mut nearest: Option<(f64, usize)> = None;
        places.for_each_within(pieces[k].at, |other, distance| {
            let other = thinned[other];
            let gap = (pieces[k].arc - pieces[other].arc).abs();
            if gap.min(length - gap) > 2.0 * width && nearest.is_none_or(|(d, _)| distance < d) {
                nearest = Some((distance, other));
            }
        });
        if let Some((distance, other)) = nearest
            && apart[other]
            && !(pieces[k].is_model && pieces[other].is_model)
        {
            crowded += pieces[k].length * stride as f64 * (width - distance).max(0.0) / (2.0 * width);
        }
    }
    crowded
}

/// Points in strips as high as the radius, each strip in the order of x: memory does not depend on the
/// extent.
struct Places {
    radius: f64,
    /// Strip, point, and the index that the caller knows it by.
    sorted: Vec<(i64, DVec2, usize)>,
}

impl Places {
    fn new(points: impl Iterator<Item = DVec2>, radius: f64) -> Self {
        let mut sorted: Vec<_> =
            points.enumerate().map(|(k, p)| ((p.y / radius).floor() as i64, p, k)).collect();
        sorted.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.x.total_cmp(&b.1.x)).then(a.2.cmp(&b.2)));
        Self { radius, sorted }
    }

    /// Visits all points within the radius of `p` with their distances, `p` itself included.
    fn for_each_within(&self, p: DVec2, mut visit: impl FnMut(usize, f64)) {
        let strip = (p.y / self.radius).floor() as i64;
        for strip in strip.saturating_sub(1)..=strip.saturating_add(1) {
            let first = self
                .sorted
                .partition_point(|&(s, q, _)| s < strip || (s == strip && q.x < p.x - self.radius));
            for &(s, q, k) in &self.sorted[first..] {
                if s != strip || q.x > p.x + self.radius {
                    break;
                }
                let distance = p.distance(q);
                if distance <= self.radius {
                    visit(k, distance);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::AuditSettings;
    use crate::settings::Tolerance;

    #[test]
    fn the_stride_is_the_same_for_every_width() {
        for k in 1..2000 {
            let settings = AuditSettings::for_width(0.013 * f64::from(k));
            let step = Tolerance::for_width(settings.width).outline_step;
            assert_eq!(stride(step / settings.step), 2, "{}", settings.width);
        }
        assert_eq!([0.0, 0.4, 1.6, 3.0, f64::INFINITY].map(stride), [1, 1, 2, 3, usize::MAX]);
    }
}
