use glam::{DAffine2, DVec2};
use roxmltree::{Document, Node};
use svgtypes::Transform;

use super::SvgSettings;
use super::attribute::{is_cut, is_hidden, line, name, parsed};
use super::height::{SLIC3R, layer_height};
use super::page::page;
use super::shape::{Shape, is_shape};
use crate::{Layers, LayersError};

const SVG: &str = "http://www.w3.org/2000/svg";

/// Elements that draw nothing by themselves.
const SILENT: [&str; 11] = [
    "defs",
    "desc",
    "metadata",
    "title",
    "style",
    "script",
    "symbol",
    "clipPath",
    "linearGradient",
    "marker",
    "pattern",
];

/// Points of all contours together: a quarter of what the layers of a mesh of the largest size may have.
pub(super) const MOST_POINTS: usize = 50_000_000;

/// How many bytes of a file are looked at to tell whether it is a drawing: more than any preface.
const HEAD: usize = 1 << 16;

/// Whether bytes begin as an SVG file does: as XML, with an element of that name soon.
#[must_use]
pub fn is_svg(bytes: &[u8]) -> bool {
    let head = bytes.get(..HEAD).unwrap_or(bytes);
    let head = head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(head);
    let names_itself = |name: &[u8]| head.windows(name.len()).any(|window| window == name);
    head.trim_ascii_start().starts_with(b"<") && (names_itself(b"<svg") || names_itself(b":svg"))
}

/// The layers of a drawing.
pub(super) fn layers(document: &Document<'_>, settings: &SvgSettings) -> Result<Layers, LayersError> {
    let root = document.root_element();
    if root.tag_name().name() != "svg" || !is_drawn(root) {
        return Err(LayersError::NoDrawing { root: name(root) });
    }
    let page = page(root, settings.unit)?;
    let (groups, to_millimetres) = groups(root, page.to_millimetres)?;
    let factor = settings.unit.map_or(1.0, argil_mesh::Unit::millimetres);
    let layer_height = layer_height(&groups)?.map(|height| height * factor);
    let mut reading = Reading { chord_error: settings.chord_error, points: 0, left_out: [(0, 0); 2] };
    let layers: Result<Vec<_>, _> = groups
        .iter()
        .enumerate()
        .map(|(layer, group)| reading.contours(layer, *group, to_millimetres))
        .collect();
    Ok(Layers { layers: layers?, layer_height, has_unit: page.has_unit, remarks: reading.remarks() })
}

/// Whether an element is one of SVG, and no note of a program to itself.
fn is_drawn(node: Node<'_, '_>) -> bool {
    node.is_element() && node.tag_name().namespace().is_none_or(|space| space == SVG)
}

/// The groups that are layers, and the transform under which they stand.
fn groups<'a, 'i>(
    root: Node<'a, 'i>,
    to_millimetres: DAffine2,
) -> Result<(Vec<Node<'a, 'i>>, DAffine2), LayersError> {
    let (mut parent, mut transform) = (root, to_millimetres);
    loop {
        let drawn = parent.children().filter(|node| is_drawn(*node) && !is_silent(*node));
        let (groups, others): (Vec<_>, Vec<_>) = drawn.partition(|node| node.tag_name().name() == "g");
        if let Some(other) = others.first() {
            return Err(LayersError::Outside { line: line(*other), element: name(*other) });
        }
        match groups[..] {
            [] => return Err(LayersError::NoLayers),
            [only] if wraps_layers(only) => {
                transform *= transform_of(only)?;
                parent = only;
            }
            _ => return Ok((groups, transform)),
        }
    }
}

/// Whether a group is not a layer but has layers: groups, and nothing else that is drawn.
fn wraps_layers(group: Node<'_, '_>) -> bool {
    let is_layer = group.has_attribute((SLIC3R, "z"));
    let mut drawn = group.children().filter(|node| is_drawn(*node) && !is_silent(*node)).peekable();
    !is_layer
        && !is_hidden(group)
        && drawn.peek().is_some()
        && drawn.all(|node| node.tag_name().name() == "g")
}

fn is_silent(node: Node<'_, '_>) -> bool {
    SILENT.contains(&node.tag_name().name())
}

fn transform_of(node: Node<'_, '_>) -> Result<DAffine2, LayersError> {
    let Some(Transform { a, b, c, d, e, f }) = parsed(node, "transform")? else {
        return Ok(DAffine2::IDENTITY);
    };
    Ok(DAffine2::from_cols_array(&[a, b, c, d, e, f]))
}

fn unsupported(layer: usize, node: Node<'_, '_>, what: &str) -> LayersError {
    LayersError::Unsupported { layer, line: line(node), what: what.to_owned() }
}

/// What is kept count of while layers are read.
struct Reading {
    chord_error: f64,
    points: usize,
    /// Elements that are not displayed, and such of support: how many, and the line of the first.
    left_out: [(usize, usize); 2],
}

impl Reading {
    /// The contours of everything in a group.
    fn contours(
        &mut self,
        layer: usize,
        group: Node<'_, '_>,
        to_millimetres: DAffine2,
    ) -> Result<Vec<Vec<DVec2>>, LayersError> {
        let mut contours = Vec::new();
        let mut open = vec![(group, to_millimetres)];
        while let Some((node, above)) = open.pop() {
            if is_hidden(node) {
                self.leave_out(0, node);
                continue;
            }
            match node.attribute((SLIC3R, "type")) {
                Some("support") => {
                    self.leave_out(1, node);
                    continue;
                }
                Some("infill") => {
                    return Err(unsupported(layer, node, "infill is not read; export with all layers solid"));
                }
                _ => {}
            }
            if is_cut(node) {
                return Err(unsupported(layer, node, "clip paths and masks are not read; apply them first"));
            }
            let transform = above * transform_of(node)?;
            match node.tag_name().name() {
                "g" => {
                    // The first child is to be met first.
                    let drawn = node.children().filter(|child| is_drawn(*child) && !is_silent(*child));
                    let first = open.len();
                    open.extend(drawn.map(|child| (child, transform)));
                    open[first..].reverse();
                }
                kind if is_shape(kind) => {
                    let shape = Shape { node, layer, transform, chord_error: self.chord_error };
                    let found = shape.contours(MOST_POINTS - self.points)?;
                    self.points += found.iter().map(Vec::len).sum::<usize>();
                    contours.extend(found);
                }
                other => {
                    return Err(unsupported(
                        layer,
                        node,
                        &format!("`{other}` is not read; convert it to a path"),
                    ));
                }
            }
        }
        Ok(contours)
    }

    fn leave_out(&mut self, kind: usize, node: Node<'_, '_>) {
        let (count, first) = &mut self.left_out[kind];
        if *count == 0 {
            *first = line(node);
        }
        *count += 1;
    }

    fn remarks(&self) -> Vec<String> {
        let kinds = ["that are not displayed", "of another program's support"];
        let met = self.left_out.iter().zip(kinds).filter(|((count, _), _)| *count > 0);
        met.map(|((count, first), kind)| {
            format!("{count} elements {kind} are left out, the first on line {first}")
        })
        .collect()
    }
}
