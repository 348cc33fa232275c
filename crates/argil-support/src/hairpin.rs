//! Where a curve turns back on itself.

use argil_curve::ClosedCurve;

/// How much of a reversal each place of a curve is: 0 on straight strand, 1 at the tip of a hairpin.
pub(crate) struct Hairpins {
    spacing: f64,
    /// One value a sample, samples evenly spaced from arc length 0.
    sharpness: Vec<f64>,
}

impl Hairpins {
    /// Judges by the chord over `reach` of arc either way: straight strand has the full chord, a tip none.
    pub(crate) fn of(curve: &ClosedCurve, step: f64, reach: f64) -> Self {
        let samples = curve.resampled(step);
        let count = samples.len();
        let spacing = curve.length() / count as f64;
        // On a tiny loop the two ends of the chord must not pass each other.
        let offset = ((reach / spacing).round() as usize).clamp(1, (count / 4).max(1));
        let full = 2.0 * offset as f64 * spacing;
        let sharpness = (0..count)
            .map(|k| {
                let chord = samples[(k + count - offset) % count].distance(samples[(k + offset) % count]);
                (1.0 - chord / full).clamp(0.0, 1.0)
            })
            .collect();
        Self { spacing, sharpness }
    }

    /// The value of the sample nearest to arc length `s`, which is not negative.
    pub(crate) fn at(&self, s: f64) -> f64 {
        let sample = (s / self.spacing).round() as usize;
        self.sharpness[sample % self.sharpness.len()]
    }

    /// Arc length of the sample that is least like a tip.
    pub(crate) fn straightest(&self) -> f64 {
        let mut best = 0;
        for (k, &value) in self.sharpness.iter().enumerate() {
            if value < self.sharpness[best] {
                best = k;
            }
        }
        best as f64 * self.spacing
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use argil_curve::DVec2;

    #[test]
    fn the_ends_of_a_there_and_back_line_are_tips() {
        let line = ClosedCurve::new(vec![DVec2::ZERO, DVec2::new(10.0, 0.0)]).unwrap();
        let hairpins = Hairpins::of(&line, 0.2, 1.2);
        assert!(hairpins.at(10.0) > 0.99 && hairpins.at(0.0) > 0.99 && hairpins.at(5.0) < 1e-9);
        assert!(hairpins.at(hairpins.straightest()) < 1e-9);
    }
}
