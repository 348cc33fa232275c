//! Drawings of which every group is a layer.

mod attribute;
mod drawing;
mod height;
mod page;
mod shape;

use argil_mesh::Unit;
use roxmltree::{Document, ParsingOptions};

pub use drawing::is_svg;

use crate::{Layers, LayersError};

/// Elements, texts and comments of a file: memory for them is bounded before the tree is made.
const MOST_NODES: u32 = 20_000_000;

/// How a drawing is read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SvgSettings {
    /// The unit of its coordinates, in place of the one that its page states.
    pub unit: Option<Unit>,
    /// How far a chord may lie beside its curve, in millimetres; 0.001 of a bead is far below what shows. At least 1e-4, the
    /// output grid of the planner.
    pub chord_error: f64,
}

impl Default for SvgSettings {
    fn default() -> Self {
        Self { unit: None, chord_error: 1.5e-3 }
    }
}

/// Layers from an SVG drawing: the groups of its root are the layers in the order of the file, the lowest first. If the root has one group
/// only, and that has groups and no shapes, then its groups are the layers.
///
/// Contours are those of `path`, `polygon`, `polyline`, `rect`, `circle` and `ellipse`, with all transforms on the way; fill and
/// stroke do not matter. The drawing is the layer as it is seen from above: the lower left corner of the page is the origin, y
/// runs up. The page's width and height with its view box state the unit; where they are plain numbers, a unit is a millimetre.
///
/// What Slic3r calls support is left out with a remark, and so is what is not displayed.
///
/// # Errors
/// [`LayersError`], with layer and line where there is one. Whatever could stand for solid and is not read (text, images, uses, nested
/// drawings, round corners of rectangles) is an error, and so is a contour that does not close.
///
/// # Complexity
/// Linear in the bytes and in the points of the contours, of which there are at most 50 million.
///
/// # Example
/// ```
/// use argil_layers::{SvgSettings, svg};
/// let drawing = br#"<svg xmlns="http://www.w3.org/2000/svg" width="40mm" height="30mm" viewBox="0 0 400 300">
///   <g><rect x="100" y="100" width="200" height="100"/></g>
///   <g><path d="M 100 100 h 200 v 100 h -200 z"/></g>
/// </svg>"#;
/// let layers = svg(drawing, &SvgSettings::default())?;
/// assert_eq!(layers.layers[0][0][0].to_array(), [10.0, 20.0]);
/// assert_eq!(layers.layers[0], layers.layers[1]);
/// # Ok::<(), argil_layers::LayersError>(())
/// ```
pub fn svg(bytes: &[u8], settings: &SvgSettings) -> Result<Layers, LayersError> {
    let text =
        std::str::from_utf8(bytes).map_err(|error| LayersError::NotText { byte: error.valid_up_to() })?;
    // Programs write a DOCTYPE; entities are bounded in depth and number by the parser, and external ones are not read.
    let options = ParsingOptions { allow_dtd: true, nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text.trim_start_matches('\u{feff}'), options)
        .map_err(|error| LayersError::Xml { why: error.to_string() })?;
    drawing::layers(&document, settings)
}
