//! What the test prints are made for.

use argil_strand::{BeadShape, DVec2, Strand};

use crate::{CalibrateError, fan, ring, windows};

/// The bead that is tried, and where the prints stand.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct Calibration {
    /// Width of the bead, mm. Default 1.5. What a paste bears is a share of it, but not the same share at every width:
    /// try the one that will be printed with.
    pub width: f64,
    /// Height of a layer, mm. Default 0.5.
    pub layer_height: f64,
    /// Middle of each print on the bed, mm. Default the origin.
    pub centre: DVec2,
    /// Cross-section by which paste is reckoned. Default rounded.
    pub bead: BeadShape,
    /// Paste in mm³ that one unit of E is taken to push out, for the legend's lines on flow. Default `None`: the
    /// machine is told nothing of E in such units, and the legend gives factors alone.
    pub mm3_per_e: Option<f64>,
}

impl Default for Calibration {
    fn default() -> Self {
        Self {
            width: 1.5,
            layer_height: 0.5,
            centre: DVec2::ZERO,
            bead: BeadShape::default(),
            mm3_per_e: None,
        }
    }
}

impl Calibration {
    /// A ring of nine sectors, each of which leans out by its own share of [`LEANS`](crate::LEANS) a layer: the last
    /// good one tells `ε_across`.
    ///
    /// From above it is a fan: the first sector is upright and holds the seam, and each further one, counter-clockwise,
    /// leans more. Short fins join neighbours; the long one before the first sector shows where to begin counting. A
    /// sector rests on itself alone, so that one which gives way takes no other with it.
    ///
    /// # Errors
    /// A bead or place that cannot be printed.
    ///
    /// # Complexity
    /// Constant: some 1,500 moves.
    pub fn fan(&self) -> Result<Strand, CalibrateError> {
        fan::fan(&self.checked()?)
    }

    /// A box whose long sides have ten windows, each as wide as its number of [`GAPS`](crate::GAPS) says: the last one
    /// with a straight lintel tells `ε_along`.
    ///
    /// The strand cannot be interrupted for a window, so it turns inwards there and comes back on the other side; the
    /// layers above go straight across. Widths are clear widths, between the edges of beads: that is what the rule of
    /// support measures where `ε_across` is half a bead, and less than it measures where it is smaller.
    ///
    /// # Errors
    /// A bead or place that cannot be printed.
    ///
    /// # Complexity
    /// Constant: some 300 moves.
    pub fn windows(&self) -> Result<Strand, CalibrateError> {
        windows::windows(&self.checked()?)
    }

    /// An upright wall of two long sides and round ends, to be measured with a calliper and weighed.
    ///
    /// # Errors
    /// A bead or place that cannot be printed.
    ///
    /// # Complexity
    /// Constant: some 400 moves.
    pub fn ring(&self) -> Result<Strand, CalibrateError> {
        ring::ring(&self.checked()?)
    }

    /// The overhang of a lean in bead widths a layer, in degrees from the vertical: what a material's file states.
    #[must_use]
    pub fn overhang(&self, lean: f64) -> f64 {
        (lean * self.width / self.layer_height).atan().to_degrees()
    }

    /// By how much more paste than reckoned a machine pushes out if the bead comes out this wide, mm.
    #[must_use]
    pub fn flow(&self, measured: f64) -> f64 {
        self.bead.area(measured, self.layer_height) / self.bead.area(self.width, self.layer_height)
    }

    /// Refuses what cannot be printed.
    fn checked(&self) -> Result<Self, CalibrateError> {
        let reach = 1e4 * self.width;
        for (name, value, low, high, must_be) in [
            ("width", self.width, 1e-2, 1e3, "between 0.01 and 1000 mm"),
            (
                "layer_height",
                self.layer_height,
                0.05 * self.width,
                2.0 * self.width,
                "between a twentieth of the width and twice the width",
            ),
            ("centre", self.centre.x, -reach, reach, "within 10,000 widths of the origin"),
            ("centre", self.centre.y, -reach, reach, "within 10,000 widths of the origin"),
        ] {
            if !(value >= low && value <= high) {
                return Err(CalibrateError::Setting { name, value, must_be });
            }
        }
        Ok(*self)
    }
}
