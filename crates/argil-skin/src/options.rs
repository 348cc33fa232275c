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
    /// Distance of the lanes of a zone, in w: 1 as a bead is wide, less to hold water, which costs clay in proportion. Narrower gaps then
    /// get a lane there and back, too.
    pub lanes: f64,
    /// Whether gaps between walls that are narrower than a bead, and wider than half of one, get a lane there and back. It lies partly on
    /// the walls' beads: floors that are to hold water want that, roofs can do without.
    pub tight: bool,
    /// How zones are filled. Its `walls` is not read, since the walls are there already.
    pub fill: FillOptions,
}

/// Wider gaps between lanes that lie closer than a bead are closed, in their distance. At joints stay discs of a quarter of it that no
/// lane can reach.
const GAP: f64 = 0.29;

impl SkinOptions {
    /// Nothing closed, one wall, a bead of this width in mm.
    #[must_use]
    pub fn for_width(width: f64) -> Self {
        Self {
            walls: 1,
            floor: 0,
            skin: 0,
            lanes: 1.0,
            tight: false,
            fill: FillOptions { walls: 0, ..FillOptions::for_width(width) },
        }
    }

    /// How lanes are laid: what is as wide as a lane for [`argil_fill`] is a bead, and covers more.
    pub(crate) fn laid(&self) -> FillOptions {
        if self.lanes >= 1.0 {
            return self.fill;
        }
        let FillOptions { width, residue, bare, .. } = self.fill;
        FillOptions { width: self.lanes * width, residue: residue.min(GAP), bare: bare.min(GAP), ..self.fill }
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
