use thiserror::Error;

/// Why bytes are no layers.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum LayersError {
    /// JSON that is none, or that is not of the form that is read.
    #[error("{why}")]
    Json {
        /// What is wrong, with line and column.
        why: String,
    },
    /// A unit of length that is none.
    #[error("there is no unit `{name}`; it is one of micron, mm, cm, inch, foot, m")]
    Unit {
        /// What the file has for it.
        name: String,
    },
    /// The bytes are no text.
    #[error("the file is no text in UTF-8, from byte {byte} on")]
    NotText {
        /// The first byte that is none.
        byte: usize,
    },
    /// Text that is no XML.
    #[error("no XML: {why}")]
    Xml {
        /// What is wrong, with line and column.
        why: String,
    },
    /// XML whose root is not `svg`.
    #[error("its root is `{root}`, not `svg`")]
    NoDrawing {
        /// The root's name.
        root: String,
    },
    /// A drawing without a group.
    #[error("it has no group: each layer has to be a group (`g`) of the drawing, the lowest first")]
    NoLayers,
    /// A shape that belongs to no layer.
    #[error(
        "line {line}: `{element}` belongs to no layer; each layer has to be a group (`g`) of the drawing"
    )]
    Outside {
        /// The line of the file.
        line: usize,
        /// Name of the element.
        element: String,
    },
    /// Something that SVG allows and that is not read.
    #[error("layer {layer}, line {line}: {what}")]
    Unsupported {
        /// The layer, 0 at the bottom.
        layer: usize,
        /// The line of the file.
        line: usize,
        /// What, and what would do.
        what: String,
    },
    /// An attribute whose value cannot be read.
    #[error("line {line}: `{name}` of `{element}`: {why}")]
    Attribute {
        /// The line of the file.
        line: usize,
        /// Name of the element.
        element: String,
        /// Name of the attribute.
        name: &'static str,
        /// What is wrong with it.
        why: String,
    },
    /// A contour whose end is not its beginning.
    #[error(
        "layer {layer}, line {line}: a contour is open by {gap} mm between ({:.3}, {:.3}) and ({:.3}, {:.3})",
        ends[0][0], ends[0][1], ends[1][0], ends[1][1]
    )]
    Open {
        /// The layer, 0 at the bottom.
        layer: usize,
        /// The line of the file.
        line: usize,
        /// From its end to its beginning, in millimetres.
        gap: f64,
        /// Beginning and end in millimetres, as the drawing is seen.
        ends: [[f64; 2]; 2],
    },
    /// A coordinate that is too large for lengths.
    #[error("layer {layer}, line {line}: a coordinate is not finite or beyond {limit:e} mm")]
    Far {
        /// The layer, 0 at the bottom.
        layer: usize,
        /// The line of the file.
        line: usize,
        /// The largest coordinate.
        limit: f64,
    },
    /// Layers that do not follow each other at one height.
    #[error("layer {layer} is {found} mm high, the others {height} mm: one height for all is needed")]
    Heights {
        /// The layer, 0 at the bottom.
        layer: usize,
        /// Its height in millimetres.
        found: f64,
        /// Height of the others in millimetres.
        height: f64,
    },
    /// More than is taken.
    #[error("more than {limit} {what}")]
    TooMany {
        /// Of what.
        what: &'static str,
        /// How many are taken.
        limit: usize,
    },
}
