//! Text and numbers as SVG wants them.

use std::fmt;

/// A number with up to three decimals; what is not finite is written as 0, so that a picture stays readable.
#[derive(Clone, Copy)]
pub(crate) struct Num(pub(crate) f64);

impl fmt::Display for Num {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rounded = (self.0 * 1000.0).round() / 1000.0;
        let value = if rounded.is_finite() { rounded } else { 0.0 };
        // Adding 0 turns -0 into 0.
        write!(f, "{}", value + 0.0)
    }
}

/// Text between tags or quotes, with the characters that mean something in XML replaced and those that XML cannot
/// hold left out.
pub(crate) struct Escaped<'t>(pub(crate) &'t str);

impl fmt::Display for Escaped<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for c in self.0.chars() {
            match c {
                '&' => f.write_str("&amp;")?,
                '<' => f.write_str("&lt;")?,
                '>' => f.write_str("&gt;")?,
                '"' => f.write_str("&quot;")?,
                '\'' => f.write_str("&#39;")?,
                '\t' | '\n' | '\r' => f.write_str(" ")?,
                '\u{fffe}' | '\u{ffff}' => {}
                c if c.is_control() => {}
                c => write!(f, "{c}")?,
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::{Escaped, Num};

    #[test]
    fn text_cannot_become_markup() {
        assert_eq!(Escaped("<a b=\"c\">&'\u{0}\n").to_string(), "&lt;a b=&quot;c&quot;&gt;&amp;&#39; ");
    }

    #[test]
    fn numbers_are_short_and_finite() {
        let text = |value: f64| Num(value).to_string();
        assert_eq!([text(1.0), text(-0.0001), text(2.34567), text(f64::NAN)], ["1", "0", "2.346", "0"]);
        assert_eq!([text(f64::INFINITY), text(f64::MAX)], ["0", "0"]);
    }
}
