//! How steeply the strand climbs: what shows as a step, and what does not.

use crate::motion::Motion;

/// The most that the nozzle rises within `width` mm of its path in the plane, mm.
///
/// The path's height is linear between its points, so the steepest stretch of a given length begins or ends at one of them.
pub(crate) fn steepest(motions: &[Motion], width: f64) -> f64 {
    let mut points = Vec::with_capacity(motions.len() + 1);
    points.extend(motions.first().map(|m| (0.0, m.z)));
    let mut way = 0.0;
    for m in motions {
        way += m.length();
        points.push((way, m.z + m.rise));
    }
    // Backwards the same path falls: what begins at a point there ends at it here.
    let ending = most(&points, width);
    points.reverse();
    points.iter_mut().for_each(|(arc, z)| (*arc, *z) = (way - *arc, -*z));
    ending.max(most(&points, width))
}

/// The greatest rise of a stretch of this length, or shorter at the beginning, that ends at a point.
fn most(points: &[(f64, f64)], width: f64) -> f64 {
    let mut first = 0;
    let mut most: f64 = 0.0;
    for &(arc, z) in points {
        let begin = arc - width;
        while points.get(first + 1).is_some_and(|next| next.0 <= begin) {
            first += 1;
        }
        let (from, low) = points[first];
        let before = match points.get(first + 1) {
            Some(&(to, high)) if to > from && begin > from => {
                low + (high - low) * (begin - from) / (to - from)
            }
            _ => low,
        };
        most = most.max(z - before);
    }
    most
}

#[cfg(test)]
mod tests {
    use super::*;
    use argil_curve::DVec2;

    fn path(points: &[(f64, f64)]) -> Vec<Motion> {
        let motion = |ends: &[(f64, f64)]| Motion {
            from: DVec2::new(ends[0].0, 0.0),
            to: DVec2::new(ends[1].0, 0.0),
            z: ends[0].1,
            rise: ends[1].1 - ends[0].1,
            extruded: 1.0,
            layer: 0,
            is_extra: false,
            is_fill: false,
        };
        points.windows(2).map(motion).collect()
    }

    #[test]
    fn a_step_is_a_layer_high_and_a_slope_is_not() {
        assert_eq!(steepest(&path(&[(0.0, 0.5), (30.0, 0.5), (31.0, 1.0), (60.0, 1.0)]), 1.5), 0.5);
        assert!((steepest(&path(&[(0.0, 0.5), (30.0, 1.0), (60.0, 1.5)]), 1.5) - 0.025).abs() < 1e-12);
        // Between two points, and with a step that is not whole in any stretch.
        let bent = path(&[(0.0, 0.0), (10.0, 0.0), (14.0, 2.0), (20.0, 2.0)]);
        assert!((steepest(&bent, 3.0) - 1.5).abs() < 1e-12);
        assert_eq!(steepest(&[], 1.5), 0.0);
    }
}
