//! An SVG as a PNG.

use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::{ImageHrefResolver, Options, Tree};

/// Longest side of a picture, pixels: a square of it takes 1 GB while it is drawn.
const LONGEST: u32 = 16_384;

/// Why no PNG was made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PreviewError {
    /// The text is no SVG.
    #[error("the picture is no SVG")]
    Svg(#[from] Box<dyn std::error::Error + Send + Sync>),
    /// A side of no pixels or of too many.
    #[error("a picture of {side} pixels cannot be made: 1 to {most} can")]
    Side {
        /// Longer side asked for, pixels.
        side: u32,
        /// Longest side that is accepted, pixels.
        most: u32,
    },
    /// The drawn picture could not be stored as PNG.
    #[error("the picture cannot be stored: {reason}")]
    Encoding {
        /// What the encoder says.
        reason: String,
    },
}

/// Draws an SVG on white, its longer side `max_side` pixels long, and stores it as PNG.
///
/// Text is left out, since fonts would have to be found and would differ from machine to machine: the same SVG gives
/// the same bytes. Images that an SVG refers to are not loaded.
///
/// # Errors
/// Text that is no SVG, or a side that is 0 or longer than 16,384 pixels.
///
/// # Example
/// ```
/// let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" width="4" height="2"><rect width="4" height="2"/></svg>"#;
/// let bytes = argil_preview::png(svg, 40)?;
/// assert_eq!(bytes[1..4], *b"PNG");
/// // Width and height stand in the header, big-endian.
/// assert_eq!((bytes[19], bytes[23]), (40, 20));
/// # Ok::<(), argil_preview::PreviewError>(())
/// ```
pub fn png(svg: &str, max_side: u32) -> Result<Vec<u8>, PreviewError> {
    let no_picture = PreviewError::Side { side: max_side, most: LONGEST };
    if max_side == 0 || max_side > LONGEST {
        return Err(no_picture);
    }
    let images =
        ImageHrefResolver { resolve_data: Box::new(|_, _, _| None), resolve_string: Box::new(|_, _| None) };
    let options = Options { image_href_resolver: images, ..Options::default() };
    let tree = Tree::from_str(svg, &options).map_err(|error| PreviewError::Svg(Box::new(error)))?;
    let size = tree.size();
    let scale = max_side as f32 / size.width().max(size.height());
    let side = |length: f32| ((length * scale).round() as u32).clamp(1, max_side);
    let mut picture = Pixmap::new(side(size.width()), side(size.height())).ok_or(no_picture)?;
    picture.fill(Color::WHITE);
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut picture.as_mut());
    picture.encode_png().map_err(|error| PreviewError::Encoding { reason: error.to_string() })
}
