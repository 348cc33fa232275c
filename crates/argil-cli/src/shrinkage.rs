//! What clay shrinks by.

use std::str::FromStr;

/// What each axis shrinks by from wet to fired, in per cent of the wet length.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub(crate) struct Shrinkage([f64; 3]);

/// No clay shrinks by so much; a model would become tenfold.
const MOST: f64 = 90.0;

impl Shrinkage {
    /// What lengths are multiplied by, so that they are right after shrinking.
    pub(crate) fn factors(self) -> [f64; 3] {
        self.0.map(|percent| 1.0 / (1.0 - 0.01 * percent))
    }
}

impl FromStr for Shrinkage {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let percent = |part: &str| {
            let value = part.trim().parse::<f64>().ok().filter(|value| (0.0..=MOST).contains(value));
            value.ok_or_else(|| format!("`{part}` is no number from 0 to {MOST}"))
        };
        let values = text.split(',').map(percent).collect::<Result<Vec<f64>, String>>()?;
        match values[..] {
            [all] => Ok(Self([all; 3])),
            [x, y, z] => Ok(Self([x, y, z])),
            _ => Err("one number, or three: x, y and z".to_owned()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_shrinks_to_a_length_was_longer_before() {
        let [x, y, z] = "10, 20,0".parse::<Shrinkage>().unwrap().factors();
        assert!((x * 0.9 - 1.0).abs() < 1e-12 && (y * 0.8 - 1.0).abs() < 1e-12 && z == 1.0);
        assert_eq!("8".parse(), Ok(Shrinkage([8.0; 3])));
    }

    #[test]
    fn what_is_no_shrinkage_is_refused() {
        for text in ["", "a", "-1", "91", "nan", "1,2", "1,2,3,4", "5,,5"] {
            assert!(text.parse::<Shrinkage>().is_err(), "{text}");
        }
    }
}
