/// An affine map as 3MF writes it: three rows for the axes and one for the shift, applied to row vectors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Transform([f64; 12]);

impl Transform {
    pub(crate) const IDENTITY: Self = Self([1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);

    /// Twelve finite numbers between blanks.
    pub(crate) fn parse(text: &str) -> Option<Self> {
        let mut values = [0.0; 12];
        let mut words = text.split_ascii_whitespace();
        for value in &mut values {
            *value = words.next()?.parse().ok().filter(|value: &f64| value.is_finite())?;
        }
        words.next().is_none().then_some(Self(values))
    }

    pub(crate) fn apply(&self, p: [f64; 3]) -> [f64; 3] {
        let m = &self.0;
        [0, 1, 2].map(|axis| p[0] * m[axis] + p[1] * m[3 + axis] + p[2] * m[6 + axis] + m[9 + axis])
    }

    /// First this one, then the other.
    pub(crate) fn then(&self, other: &Self) -> Self {
        let origin = other.apply([0.0; 3]);
        let row = |k: usize| {
            let moved = other.apply([self.0[3 * k], self.0[3 * k + 1], self.0[3 * k + 2]]);
            [0, 1, 2].map(|axis| moved[axis] - origin[axis])
        };
        let [a, b, c] = [row(0), row(1), row(2)];
        let d = other.apply([self.0[9], self.0[10], self.0[11]]);
        Self([a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2], d[0], d[1], d[2]])
    }

    /// The same map where lengths are counted in another unit.
    pub(crate) fn with_shift_times(mut self, factor: f64) -> Self {
        self.0[9..].iter_mut().for_each(|value| *value *= factor);
        self
    }

    /// Whether it turns the outside of a triangle in.
    pub(crate) fn mirrors(&self) -> bool {
        let m = &self.0;
        let determinant = m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6])
            + m[2] * (m[3] * m[7] - m[4] * m[6]);
        determinant < 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_are_applied_one_after_the_other() {
        let turn = Transform::parse("0 1 0 -1 0 0 0 0 1 5 6 7").expect("a map");
        let scale = Transform::parse("2 0 0 0 3 0 0 0 -1 1 0 0").expect("a map");
        assert_eq!(turn.apply([1.0, 0.0, 0.0]), [5.0, 7.0, 7.0]);
        let p = [1.0, 2.0, 3.0];
        assert_eq!(turn.then(&scale).apply(p), scale.apply(turn.apply(p)));
        assert!(!turn.mirrors() && scale.mirrors() && turn.then(&scale).mirrors());
        assert_eq!(Transform::parse("1 0 0 0 1 0 0 0 1 0 0"), None);
        assert_eq!(Transform::parse("1 0 0 0 1 0 0 0 1 0 0 inf"), None);
    }
}
