//! What is to be closed, and how thickly.

use argil_fill::{FillError, FillOptions};

/// What is to be closed, and how thickly.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct SkinOptions {
    /// How many walls lie inside each other along an outline. Fill begins where they end.
    pub walls: usize,
    /// How many of the lowest layers are filled whole.
    pub floor: usize,
    /// How many layers close each face that looks up or down: the layer that has the face, and those behind it.
    pub skin: usize,
    /// Whether gaps between walls that are narrower than a bead, and wider than half of one, get a lane there and back. It lies partly on
    /// the walls' beads: floors that are to hold water want that, roofs can do without.
    pub tight: bool,
    /// How zones are filled. Its `walls` is not read, since the walls are there already.
    pub fill: FillOptions,
}

impl SkinOptions {
    /// Nothing closed, one wall, a bead of this width in mm.
    #[must_use]
    pub fn for_width(width: f64) -> Self {
        Self {
            walls: 1,
            floor: 0,
            skin: 0,
            tight: false,
            fill: FillOptions { walls: 0, ..FillOptions::for_width(width) },
        }
    }

    /// Refuses a width that no zone can be found with; the other options are checked where a zone is filled.
    pub(crate) fn width(&self) -> Result<f64, FillError> {
        let value = self.fill.width;
        let expected = "positive and finite";
        if value > 0.0 && value.is_finite() {
            Ok(value)
        } else {
            Err(FillError::Option { name: "width", value, expected })
        }
    }
}
