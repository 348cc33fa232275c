//! Paths that keep apart from themselves.

use argil_curve::{DVec2, Segment, SegmentIndex, self_crossings};

/// What a path keeps from itself, in steps of the grid.
const LEAST_GAP: f64 = 6.0;

/// Whether a closed path crosses itself nowhere and keeps more than a few steps of the grid from itself, so that it stays simple
/// where a vertex is added and rounded.
pub(crate) fn is_apart(points: &[DVec2], grid: f64) -> bool {
    let n = points.len();
    let sides: Vec<Segment> = (0..n).map(|k| Segment::new(points[k], points[(k + 1) % n])).collect();
    let usual = sides.iter().map(Segment::length).sum::<f64>() / n.max(1) as f64;
    let index = SegmentIndex::new(sides.clone(), usual.max(grid));
    self_crossings(points).is_empty()
        && (0..n).all(|k| {
            let mut apart = true;
            index.for_each_near(sides[k], LEAST_GAP * grid, |other, side| {
                let beside = other == k || other == (k + 1) % n || (other + 1) % n == k;
                apart &= beside || sides[k].distance_to(&side) > LEAST_GAP * grid;
            });
            apart
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is(points: &[(f64, f64)]) -> bool {
        is_apart(&points.iter().map(|&p| DVec2::from(p)).collect::<Vec<_>>(), 1e-4)
    }

    #[test]
    fn a_path_that_nearly_touches_itself_is_not_apart() {
        let pinched = |gap: f64| [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (2.0, gap), (0.0, 4.0)];
        assert!(is(&pinched(0.01)) && !is(&pinched(0.0002)) && !is(&pinched(-0.01)));
    }

    #[test]
    fn a_corner_that_turns_back_over_a_short_side_is_not_apart() {
        let back =
            [(2.1113, -10.5586), (1.1123, -10.3598), (1.1134, -10.3548), (1.4251, -10.5105), (1.9, -11.0)];
        assert!(!is(&back));
    }
}
