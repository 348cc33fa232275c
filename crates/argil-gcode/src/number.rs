//! Decimal numbers on a grid: rounding happens once, in integers, so that what is written is what was reckoned with.

use std::fmt;

/// Integers above this are not all exact as `f64`, so neither would be what a reader gets.
const EXACT: f64 = 9_007_199_254_740_992.0;

/// A grid of decimals: 4 decimals are steps of 1e-4.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Grid {
    decimals: u8,
    per_unit: f64,
}

impl Grid {
    pub(crate) fn new(decimals: u8) -> Self {
        Self { decimals, per_unit: 10f64.powi(i32::from(decimals)) }
    }

    pub(crate) fn decimals(self) -> u8 {
        self.decimals
    }

    /// The nearest grid step, or `None` where steps are no longer exact integers.
    pub(crate) fn step(self, value: f64) -> Option<i64> {
        let steps = (value * self.per_unit).round();
        (steps.abs() < EXACT).then_some(steps as i64)
    }

    /// A length in steps, not rounded.
    pub(crate) fn units(self, value: f64) -> f64 {
        value * self.per_unit
    }

    /// The number as text.
    pub(crate) fn text(self, steps: i64) -> Decimal {
        Decimal { steps, decimals: self.decimals }
    }
}

/// A number on a grid; its text has no trailing zeros and no exponent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Decimal {
    steps: i64,
    decimals: u8,
}

impl fmt::Display for Decimal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let unit = 10u64.pow(u32::from(self.decimals));
        let steps = self.steps.unsigned_abs();
        let (whole, mut fraction) = (steps / unit, steps % unit);
        if self.steps < 0 {
            f.write_str("-")?;
        }
        write!(f, "{whole}")?;
        if fraction > 0 {
            let mut digits = usize::from(self.decimals);
            while fraction % 10 == 0 {
                fraction /= 10;
                digits -= 1;
            }
            write!(f, ".{fraction:0digits$}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::Grid;

    #[test]
    fn decimals_are_rounded_once_and_lose_their_trailing_zeros() {
        let text = |value: f64, decimals| {
            let grid = Grid::new(decimals);
            grid.text(grid.step(value).unwrap()).to_string()
        };
        assert_eq!(text(0.0, 4), "0");
        assert_eq!(text(-0.00004, 4), "0");
        assert_eq!(text(-0.5, 4), "-0.5");
        assert_eq!(text(12.030_04, 4), "12.03");
        assert_eq!(text(1.000_05, 4), "1.0001");
        assert_eq!(text(-3.0, 0), "-3");
        assert_eq!(text(100.0, 3), "100");
    }

    #[test]
    fn what_is_no_longer_exact_is_refused() {
        for value in [1e20, f64::INFINITY, f64::NAN] {
            assert_eq!(Grid::new(4).step(value), None);
        }
    }
}
