//! A picture among the comments of a g-code file.

use crate::base64::Base64;

/// Letters of a line, as the slicers that began with such pictures have it.
const LINE: usize = 78;

/// A PNG as lines of comment that Klipper's pages (by way of Moonraker) and OctoPrint show as a thumbnail: width, height
/// and the number of letters, then the picture in base64. No lines if the bytes are no PNG.
///
/// Readers look for it before the first move that extrudes.
///
/// # Example
/// ```
/// let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" width="4" height="2"><rect width="4" height="2"/></svg>"#;
/// let lines = argil_preview::thumbnail(&argil_preview::png(svg, 40)?);
/// assert!(lines[1].starts_with("; thumbnail begin 40x20 "));
/// assert_eq!(lines[lines.len() - 2], "; thumbnail end");
/// let letters: usize = lines[2..lines.len() - 2].iter().map(|line| line.len() - 2).sum();
/// assert_eq!(lines[1].rsplit(' ').next(), Some(letters.to_string().as_str()));
/// # Ok::<(), argil_preview::PreviewError>(())
/// ```
#[must_use]
pub fn thumbnail(png: &[u8]) -> Vec<String> {
    // Signature, then the length and name of the first chunk, which holds width and height.
    let side = |at: usize| {
        let bytes = png.get(at..at + 4)?;
        Some(bytes.iter().fold(0u32, |value, &byte| value << 8 | u32::from(byte)))
    };
    let (true, Some(width), Some(height)) = (png.starts_with(b"\x89PNG\r\n\x1a\n"), side(16), side(20))
    else {
        return Vec::new();
    };
    let text = Base64(png).to_string();
    let mut lines = vec![";".to_owned(), format!("; thumbnail begin {width}x{height} {}", text.len())];
    let mut rest = text.as_str();
    while !rest.is_empty() {
        let (line, after) = rest.split_at(rest.len().min(LINE));
        lines.push(format!("; {line}"));
        rest = after;
    }
    lines.extend(["; thumbnail end".to_owned(), ";".to_owned()]);
    lines
}

#[cfg(test)]
mod tests {
    use super::thumbnail;

    #[test]
    fn what_is_no_png_has_no_thumbnail() {
        assert!(thumbnail(b"").is_empty());
        assert!(thumbnail(b"\x89PNG\r\n\x1a\n").is_empty());
        assert!(thumbnail(&[0; 100]).is_empty());
    }
}
