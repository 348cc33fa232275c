use argil_mesh::Unit;
use glam::{DAffine2, DVec2};
use roxmltree::Node;
use svgtypes::{Length, LengthUnit, ViewBox};

use super::attribute::{parsed, unreadable};
use crate::LayersError;

/// CSS pixels in an inch.
const PIXELS: f64 = 96.0;

/// Scales of width and height that differ by less than this share are the same: pages are written with few digits.
const SAME: f64 = 0.01;

/// The page of a drawing.
pub(super) struct Page {
    /// From the drawing's coordinates to millimetres, with the lower left corner of the page as origin and y upwards.
    pub(super) to_millimetres: DAffine2,
    /// Whether the file states the unit.
    pub(super) has_unit: bool,
}

/// The page of a root element; a unit that is given comes before the one that it states.
pub(super) fn page(root: Node<'_, '_>, unit: Option<Unit>) -> Result<Page, LayersError> {
    let view: Option<ViewBox> = parsed(root, "viewBox")?;
    let sides = [parsed::<Length>(root, "width")?, parsed::<Length>(root, "height")?];
    let stated = scale(root, sides.map(|side| side.and_then(millimetres)), view.as_ref())?;
    let factor = unit.map(Unit::millimetres).or(stated).unwrap_or(1.0);
    let corner = match (&view, sides[1]) {
        (Some(view), _) => DVec2::new(view.x, view.y + view.h),
        // Without a view box the page is measured in the drawing's own units.
        (None, Some(height)) => {
            DVec2::new(0.0, millimetres(height).map_or(height.number, |height| height / 25.4 * PIXELS))
        }
        (None, None) => DVec2::ZERO,
    };
    let is_usable = factor.is_normal() && factor > 0.0 && corner.is_finite();
    if !is_usable {
        return Err(unreadable(root, "viewBox", &"the page has no size"));
    }
    let flip = DAffine2::from_scale(DVec2::new(factor, -factor));
    Ok(Page {
        to_millimetres: flip * DAffine2::from_translation(-corner),
        has_unit: unit.is_some() || stated.is_some(),
    })
}

/// Millimetres of one unit of the drawing, if the page has a width or height in a unit of length.
fn scale(
    root: Node<'_, '_>,
    sides: [Option<f64>; 2],
    view: Option<&ViewBox>,
) -> Result<Option<f64>, LayersError> {
    let Some(view) = view else {
        // The standard's own unit, where nothing else is said.
        return Ok(sides.iter().any(Option::is_some).then_some(25.4 / PIXELS));
    };
    match [sides[0].map(|side| side / view.w), sides[1].map(|side| side / view.h)] {
        [Some(x), Some(y)] if (x / y - 1.0).abs() > SAME => {
            Err(unreadable(root, "viewBox", &format!("its unit is {x} mm in width and {y} mm in height")))
        }
        [x, y] => Ok(x.or(y)),
    }
}

/// A length that does not depend on a screen, in millimetres.
fn millimetres(length: Length) -> Option<f64> {
    let factor = match length.unit {
        LengthUnit::Mm => 1.0,
        LengthUnit::Cm => 10.0,
        LengthUnit::In => 25.4,
        LengthUnit::Pt => 25.4 / 72.0,
        LengthUnit::Pc => 25.4 / 6.0,
        LengthUnit::None | LengthUnit::Px | LengthUnit::Em | LengthUnit::Ex | LengthUnit::Percent => {
            return None;
        }
    };
    let value = length.number * factor;
    (value > 0.0).then_some(value)
}
