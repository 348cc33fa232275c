//! Arcs as chords.

use std::f64::consts::TAU;

/// Chords beyond which an arc is taken for a misprint: it would be metres of path at any sensible radius.
const MOST_CHORDS: f64 = 100_000.0;

/// How far the end of an arc may lie off the circle through its start, mm and as a share of the radius. Files round
/// centres and ends to 3 decimals or so.
const OFF_CIRCLE: (f64, f64) = (0.05, 0.01);

/// An arc in the plane from a start to an end point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Arc {
    pub(crate) start: [f64; 2],
    pub(crate) end: [f64; 2],
    pub(crate) clockwise: bool,
}

/// How a line gives an arc's centre.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Centre {
    /// As an offset from the start (I and J).
    Offset([f64; 2]),
    /// By radius (R): of the two arcs the shorter for a positive, the longer for a negative one.
    Radius(f64),
}

impl Arc {
    /// Points along the arc after its start, the end last, such that no chord is farther than `tolerance` mm from the
    /// arc. `None` when there is no such arc.
    pub(crate) fn chords(&self, centre: Centre, tolerance: f64) -> Option<Vec<[f64; 2]>> {
        let ([sx, sy], [ex, ey]) = (self.start, self.end);
        let [cx, cy] = match centre {
            Centre::Offset([i, j]) => [sx + i, sy + j],
            Centre::Radius(radius) => self.centre_by_radius(radius)?,
        };
        let radius = (sx - cx).hypot(sy - cy);
        let off = ((ex - cx).hypot(ey - cy) - radius).abs();
        // Written so that a radius that is not a number is refused too.
        let fits = radius > 0.0 && radius.is_finite() && off <= OFF_CIRCLE.0.max(radius * OFF_CIRCLE.1);
        if !fits {
            return None;
        }
        let from = (sy - cy).atan2(sx - cx);
        let to = (ey - cy).atan2(ex - cx);
        let turn = if self.clockwise { (from - to).rem_euclid(TAU) } else { (to - from).rem_euclid(TAU) };
        // The same start and end by centre is a full circle.
        let turn = if self.start == self.end { TAU } else { turn };
        let step = 2.0 * (1.0 - (tolerance / radius).min(1.0)).acos();
        // Beside a huge radius both vanish: no turn over no step is a straight line, one chord.
        let count = (turn / step).ceil().max(1.0);
        if count > MOST_CHORDS {
            return None;
        }
        let signed = if self.clockwise { -turn } else { turn };
        let between = (1..count as usize).map(|k| {
            let angle = from + signed * k as f64 / count;
            [cx + radius * angle.cos(), cy + radius * angle.sin()]
        });
        Some(between.chain([self.end]).collect())
    }

    fn centre_by_radius(&self, radius: f64) -> Option<[f64; 2]> {
        let ([sx, sy], [ex, ey]) = (self.start, self.end);
        let (dx, dy) = (ex - sx, ey - sy);
        let chord = dx.hypot(dy);
        let height = radius * radius - chord * chord / 4.0;
        // A chord a little longer than the diameter is a half circle whose numbers were rounded.
        let rounded = chord / 2.0 - radius.abs() <= OFF_CIRCLE.0;
        if !(chord > 0.0 && rounded) {
            return None;
        }
        let side = if self.clockwise == (radius > 0.0) { -1.0 } else { 1.0 };
        let along = side * height.max(0.0).sqrt() / chord;
        Some([(sx + ex) / 2.0 - dy * along, (sy + ey) / 2.0 + dx * along])
    }
}

#[cfg(test)]
mod tests {
    use super::{Arc, Centre};

    #[test]
    fn a_quarter_circle_goes_the_way_it_is_told() {
        let arc = Arc { start: [10.0, 0.0], end: [0.0, 10.0], clockwise: false };
        let short = arc.chords(Centre::Offset([-10.0, 0.0]), 0.02).unwrap();
        let by_radius = arc.chords(Centre::Radius(10.0), 0.02).unwrap();
        assert_eq!(short.len(), by_radius.len());
        for (a, b) in short.iter().zip(&by_radius) {
            assert!((a[0] - b[0]).hypot(a[1] - b[1]) < 1e-9);
            assert!((a[0].hypot(a[1]) - 10.0).abs() < 1e-9 && a[0] > -1e-9 && a[1] > -1e-9);
        }
        let long = Arc { clockwise: true, ..arc }.chords(Centre::Offset([-10.0, 0.0]), 0.02).unwrap();
        assert!(long.len() > 2 * short.len() && long.iter().any(|p| p[0] < -9.0));
        assert!(arc.chords(Centre::Radius(-10.0), 0.02).unwrap().len() > 2 * short.len());
    }

    #[test]
    fn a_full_circle_keeps_to_the_tolerance() {
        let arc = Arc { start: [3.0, 0.0], end: [3.0, 0.0], clockwise: true };
        let points = arc.chords(Centre::Offset([-3.0, 0.0]), 0.02).unwrap();
        let mut last = [3.0, 0.0];
        for point in points {
            let middle = [(last[0] + point[0]) / 2.0, (last[1] + point[1]) / 2.0];
            assert!(middle[0].hypot(middle[1]) >= 3.0 - 0.02 - 1e-12);
            last = point;
        }
        assert_eq!(last, [3.0, 0.0]);
    }

    #[test]
    fn arcs_that_do_not_exist_are_refused() {
        let arc = Arc { start: [0.0, 0.0], end: [10.0, 0.0], clockwise: true };
        assert!(arc.chords(Centre::Radius(2.0), 0.02).is_none());
        assert!(arc.chords(Centre::Offset([1.0, 0.0]), 0.02).is_none());
        assert!(arc.chords(Centre::Offset([0.0, 0.0]), 0.02).is_none());
        assert!(arc.chords(Centre::Radius(f64::MAX), 0.02).is_none());
        assert!(arc.chords(Centre::Offset([5.0, 1e300]), 0.02).is_none_or(|points| points == [[10.0, 0.0]]));
        assert_eq!(arc.chords(Centre::Offset([5.0, 1e150]), 0.02), Some(vec![[10.0, 0.0]]));
    }
}
