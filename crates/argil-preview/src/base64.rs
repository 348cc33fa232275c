//! Bytes as text (RFC 4648, section 4), for data inside a page.

use std::fmt;

const ALPHABET: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Bytes that are displayed as base64, with padding and without line ends.
#[derive(Clone, Copy)]
pub(crate) struct Base64<'b>(pub(crate) &'b [u8]);

impl fmt::Display for Base64<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut group = [b'='; 4];
        for bytes in self.0.chunks(3) {
            let whole = bytes.iter().fold(0u32, |whole, &byte| whole << 8 | u32::from(byte));
            // Three bytes fill four letters of six bits; fewer bytes are moved up as if zeros followed.
            let whole = whole << (8 * (3 - bytes.len()));
            for (k, letter) in group.iter_mut().enumerate() {
                let sextet = whole >> (18 - 6 * k) & 63;
                *letter = if k <= bytes.len() { ALPHABET[sextet as usize] } else { b'=' };
            }
            for &letter in &group {
                write!(f, "{}", char::from(letter))?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::Base64;

    #[test]
    fn the_examples_of_the_standard() {
        let examples = ["", "f", "fo", "foo", "foob", "fooba", "foobar"];
        let wanted = ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"];
        assert_eq!(examples.map(|text| Base64(text.as_bytes()).to_string()), wanted);
        assert_eq!(Base64(&[0xfb, 0xff, 0xfe]).to_string(), "+//+");
    }
}
