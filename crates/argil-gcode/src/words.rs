//! The words of a line: a letter and a number.

/// A letter in upper case with the number that follows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Word {
    pub(crate) letter: u8,
    pub(crate) value: f64,
}

/// The words of a line of code without its comment.
///
/// Anything that is not a letter followed by a number is passed over, as firmware does. Blanks may stand between the
/// two. An exponent is written with a small `e`: a capital `E` right after a number begins the next word, since
/// files without blanks (`X1E5`) mean an axis by it.
pub(crate) fn words(code: &str) -> impl Iterator<Item = Word> + '_ {
    let mut rest = code;
    std::iter::from_fn(move || {
        loop {
            let at = rest.find(|c: char| c.is_ascii_alphabetic())?;
            // An ASCII letter was found there, one byte long.
            let letter = rest.as_bytes()[at].to_ascii_uppercase();
            rest = &rest[at + 1..];
            let number = rest.trim_start();
            let length = number_length(number.as_bytes());
            if length > 0 {
                // The scanner accepts a subset of what `f64` parses, so the fallback is never taken.
                let value = number[..length].parse().unwrap_or(f64::NAN);
                rest = &number[length..];
                return Some(Word { letter, value });
            }
        }
    })
}

/// Bytes at the beginning that form a number: sign, digits with at most one point among or around them, exponent.
fn number_length(text: &[u8]) -> usize {
    // Asked from the end of what was met, which is within the text.
    let digits = |from: usize| text[from..].iter().take_while(|byte| byte.is_ascii_digit()).count();
    let sign = usize::from(matches!(text.first(), Some(b'+' | b'-')));
    let whole = digits(sign);
    let mut end = sign + whole;
    if text.get(end) == Some(&b'.') {
        let fraction = digits(end + 1);
        if whole + fraction == 0 {
            return 0;
        }
        end += 1 + fraction;
    } else if whole == 0 {
        return 0;
    }
    if text.get(end) == Some(&b'e') {
        let sign = usize::from(matches!(text.get(end + 1), Some(b'+' | b'-')));
        let exponent = digits(end + 1 + sign);
        if exponent > 0 {
            end += 1 + sign + exponent;
        }
    }
    end
}

#[cfg(test)]
mod tests {
    use super::words;

    fn read(code: &str) -> Vec<(char, f64)> {
        words(code).map(|word| (char::from(word.letter), word.value)).collect()
    }

    #[test]
    fn words_are_found_among_anything() {
        assert_eq!(
            read("G1 X-1.5 Y+.5 Z2. e1e-2"),
            [('G', 1.0), ('X', -1.5), ('Y', 0.5), ('Z', 2.0), ('E', 0.01)]
        );
        assert_eq!(read("g1x1y2"), [('G', 1.0), ('X', 1.0), ('Y', 2.0)]);
        assert_eq!(read("M117 Hällo XY 5 X. -"), [('M', 117.0), ('Y', 5.0)]);
        assert_eq!(read("N7 G1 X 3*71"), [('N', 7.0), ('G', 1.0), ('X', 3.0)]);
        assert_eq!(read(""), []);
    }

    #[test]
    fn a_capital_e_after_a_number_is_an_axis() {
        assert_eq!(read("G1X10E0.5"), [('G', 1.0), ('X', 10.0), ('E', 0.5)]);
        assert_eq!(read("X10e2"), [('X', 1000.0)]);
        assert_eq!(read("X1e"), [('X', 1.0)]);
    }
}
