use crate::SliceError;

/// The most layers that are cut: five times a metre at 0.05 mm.
pub(crate) const MOST_LAYERS: usize = 100_000;

/// Lengths beyond a kilometre are a mistake, and the polygon kernel cannot grow a region by much more.
pub(crate) const LONGEST: f64 = 1e6;

/// How a mesh is cut and its walls are laid.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct SliceSettings {
    /// Layer height h in millimetres (paper: 0.5). Lower layers follow the surface better and
    /// cost strand in proportion.
    pub layer_height: f64,
    /// Bead width w in millimetres (paper: 1.5 for a 0.6 mm nozzle). Every tolerance of the
    /// walls is a fraction of it.
    pub width: f64,
    /// How many walls lie side by side, the first w/2 inside the outline (paper: 1). More walls
    /// are stronger and give later layers more to stand on.
    pub walls: usize,
    /// Step of the output coordinates in millimetres, 1e-4 by default: the four decimals that
    /// are written. Loops are checked after rounding to it.
    pub grid: f64,
    /// The widest gap in a cut, in bead widths, that is closed with a straight line, 0.5 by
    /// default: a bead covers that, so that any two ends may be joined.
    pub gap: f64,
    /// The widest gap in a cut, in bead widths, that is closed where there is little to guess: the pieces of outline on both
    /// sides are together at least twice as long as the gap. 10 by default; wider gaps are reported, a larger value guesses more.
    /// Gaps that lie inside the solid are closed at any width.
    pub hole: f64,
    /// Whether the mesh is a sheet without thickness: its sections are the paths of walls themselves, with no inset, and open ones
    /// are printed there and back. A sheet has one wall.
    pub surface: bool,
}

impl Default for SliceSettings {
    fn default() -> Self {
        Self { layer_height: 0.5, width: 1.5, walls: 1, grid: 1e-4, gap: 0.5, hole: 10.0, surface: false }
    }
}

impl SliceSettings {
    pub(crate) fn check(&self) -> Result<(), SliceError> {
        for (setting, value) in
            [("layer_height", self.layer_height), ("width", self.width), ("grid", self.grid)]
        {
            if !(value.is_normal() && value > 0.0 && value <= LONGEST) {
                return Err(SliceError::Setting { setting, value });
            }
        }
        for (setting, value) in [("gap", self.gap), ("hole", self.hole)] {
            if !(0.0..=LONGEST).contains(&value) {
                return Err(SliceError::Setting { setting, value });
            }
        }
        if self.surface && self.walls > 1 {
            return Err(SliceError::SheetWalls { walls: self.walls });
        }
        if self.walls == 0 {
            return Err(SliceError::NoWalls);
        }
        // Twenty steps must fit into the thinnest thing a wall keeps after opening, 0.04 w.
        let limit = 0.001 * self.width;
        if self.grid > limit {
            return Err(SliceError::CoarseGrid { grid: self.grid, width: self.width, limit });
        }
        Ok(())
    }
}
