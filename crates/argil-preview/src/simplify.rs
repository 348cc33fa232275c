//! Fewer points for the same line.

use argil_strand::DVec2;

/// Which points of an open line to keep so that none dropped is farther than `tolerance` from what remains (Douglas and
/// Peucker 1973, doi 10.3138/FM57-6770-U75U-7727, with a stack in place of recursion). Ends are kept.
pub(crate) fn kept(points: &[DVec2], tolerance: f64) -> Vec<usize> {
    let Some(last) = points.len().checked_sub(1) else { return Vec::new() };
    let mut keep = vec![false; points.len()];
    keep[0] = true;
    keep[last] = true;
    let mut stretches = vec![(0, last)];
    while let Some((from, to)) = stretches.pop() {
        let distances = (from + 1..to).map(|k| (k, off(points[k], points[from], points[to])));
        if let Some((k, farthest)) = distances.max_by(|a, b| a.1.total_cmp(&b.1))
            && farthest > tolerance
        {
            keep[k] = true;
            stretches.push((from, k));
            stretches.push((k, to));
        }
    }
    (0..points.len()).filter(|&k| keep[k]).collect()
}

/// Distance of a point to a segment.
fn off(p: DVec2, a: DVec2, b: DVec2) -> f64 {
    let along = b - a;
    let square = along.length_squared();
    let t = if square > 0.0 { ((p - a).dot(along) / square).clamp(0.0, 1.0) } else { 0.0 };
    p.distance(a + along * t)
}

#[cfg(test)]
mod tests {
    use super::{kept, off};
    use argil_strand::DVec2;

    #[test]
    fn what_is_dropped_is_within_the_tolerance() {
        let points: Vec<DVec2> =
            (0..200).map(|k| DVec2::new(f64::from(k) * 0.1, (f64::from(k) * 0.1).sin())).collect();
        let keep = kept(&points, 0.01);
        assert!(keep.len() < 100 && keep[0] == 0 && keep[keep.len() - 1] == 199);
        for pair in keep.windows(2) {
            for k in pair[0]..pair[1] {
                assert!(off(points[k], points[pair[0]], points[pair[1]]) <= 0.01);
            }
        }
        assert!(kept(&[], 1.0).is_empty());
        assert_eq!(kept(&[DVec2::ZERO], 1.0), [0]);
    }
}
