use roxmltree::Node;
use svgtypes::{Length, LengthUnit};

use crate::LayersError;

/// The line on which an element begins, from 1.
pub(super) fn line(node: Node<'_, '_>) -> usize {
    node.document().text_pos_at(node.range().start).row as usize
}

/// The name of an element without its namespace.
pub(super) fn name(node: Node<'_, '_>) -> String {
    node.tag_name().name().to_owned()
}

/// An attribute that cannot be read.
pub(super) fn unreadable(node: Node<'_, '_>, attribute: &'static str, why: &dyn ToString) -> LayersError {
    LayersError::Attribute { line: line(node), element: name(node), name: attribute, why: why.to_string() }
}

/// An attribute read by the standard's grammar, if it is there.
pub(super) fn parsed<T: std::str::FromStr<Err: std::fmt::Display>>(
    node: Node<'_, '_>,
    attribute: &'static str,
) -> Result<Option<T>, LayersError> {
    let text = node.attribute(attribute);
    text.map(|text| text.trim().parse().map_err(|why: T::Err| unreadable(node, attribute, &why))).transpose()
}

/// A length in the units of the drawing; 0 where it is left out.
pub(super) fn coordinate(node: Node<'_, '_>, attribute: &'static str) -> Result<f64, LayersError> {
    match parsed::<Length>(node, attribute)? {
        None => Ok(0.0),
        Some(Length { number, unit: LengthUnit::None | LengthUnit::Px }) => Ok(number),
        Some(_) => Err(unreadable(node, attribute, &"a number without a unit is needed")),
    }
}

/// Whether a shape or group is not displayed.
pub(super) fn is_hidden(node: Node<'_, '_>) -> bool {
    style(node, "display").any(|value| value == "none")
}

/// Whether only part of a shape or group is displayed.
pub(super) fn is_cut(node: Node<'_, '_>) -> bool {
    style(node, "clip-path").chain(style(node, "mask")).any(|value| value != "none")
}

/// What an element says of a property, by an attribute or in its style.
fn style<'a>(node: Node<'a, '_>, property: &'static str) -> impl Iterator<Item = &'a str> {
    let styled =
        node.attribute("style").unwrap_or_default().split(';').filter_map(|entry| entry.split_once(':'));
    let styled = styled.filter(move |(key, _)| key.trim() == property).map(|(_, value)| value.trim());
    styled.chain(node.attribute(property).map(str::trim))
}
