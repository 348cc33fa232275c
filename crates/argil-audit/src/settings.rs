//! What the audit must know of the material and of the machine's bead.

use crate::AuditError;

/// Width in mm of the bead whose figures the tolerances were chosen on; every tolerance scales with the bead
/// that it is meant for.
const REFERENCE_WIDTH: f64 = 1.5;

/// What was asked for and what the material bears. Lengths in millimetres.
///
/// # Example
/// ```
/// use argil_audit::AuditSettings;
/// let concrete = AuditSettings::for_width(30.0);
/// assert_eq!((concrete.layer_height, concrete.along), (10.0, 48.0));
/// assert_eq!(AuditSettings::default(), AuditSettings::for_width(1.5));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct AuditSettings {
    /// Bead width w. A wider bead covers more and doubles more.
    pub width: f64,
    /// Bead width that the tolerances are meant for, mm: usually w itself. A smaller one measures more strictly, in
    /// proportion; one that stays the same over several widths makes their figures comparable with programs whose
    /// tolerances are millimetres.
    pub tolerance_width: f64,
    /// Height of a layer. Layer n of the file is compared with the model cut at (n + ½) heights above its
    /// lowest point.
    pub layer_height: f64,
    /// Loops of wall asked for: loop k lies (k + ½) w inside the outline. At least 1.
    pub walls: usize,
    /// How many of the lowest layers are to be closed whole.
    pub floor: usize,
    /// Whether every face that looks up or down and is wider than a bead is to be closed.
    pub skin: bool,
    /// Whether the mesh is a sheet without thickness: the paths of walls are its sections themselves.
    pub surface: bool,
    /// How far a bead may lie beside the one below it and still be held, `ε_across` of the paper's Section
    /// 3.2. It belongs to the paste: other presets use half of the default 0.3 w, which reports more spans.
    pub across: f64,
    /// The longest bridge that the paste bears, `ε_along` of the paper's Section 3.2.
    pub along: f64,
    /// Spacing of the samples along the path. Half of it doubles the time; spans are known to about two
    /// steps.
    pub step: f64,
    /// What must be added to the mesh's x and y to get the file's coordinates.
    pub offset: [f64; 2],
}

impl Default for AuditSettings {
    /// Clay through a 0.6 mm nozzle: a bead 1.5 mm wide in layers of 0.5 mm.
    fn default() -> Self {
        Self::for_width(REFERENCE_WIDTH)
    }
}

impl AuditSettings {
    /// The proportions of the clay profile for a bead of another width, in mm: layers of w/3, one wall,
    /// `ε_across` 0.3 w, `ε_along` 1.6 w, samples every w/15.
    #[must_use]
    pub fn for_width(width: f64) -> Self {
        Self {
            width,
            tolerance_width: width,
            layer_height: width / 3.0,
            walls: 1,
            floor: 0,
            skin: false,
            surface: false,
            across: 0.3 * width,
            along: 1.6 * width,
            step: width / 15.0,
            offset: [0.0, 0.0],
        }
    }

    pub(crate) fn checked(&self) -> Result<(), AuditError> {
        let positive = [
            ("width", self.width),
            ("tolerance_width", self.tolerance_width),
            ("layer_height", self.layer_height),
            ("across", self.across),
            ("along", self.along),
            ("step", self.step),
        ];
        for (name, value) in positive {
            if !(value.is_finite() && value > 0.0) {
                return Err(AuditError::Setting { name, value });
            }
        }
        if self.walls == 0 {
            return Err(AuditError::Setting { name: "walls", value: 0.0 });
        }
        match self.offset.into_iter().find(|v| !v.is_finite()) {
            Some(value) => Err(AuditError::Setting { name: "offset", value }),
            None => Ok(()),
        }
    }
}

/// The tolerances of the measures, in mm, for one bead width. The values in the comments are those at w =
/// 1.5.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tolerance {
    /// 0.12: the wall is laid where a bead's centre lies this near. Room for the file's rounding and for
    /// chords.
    pub(crate) laid: f64,
    /// 0.1: a bead whose centre lies this near to a wall path belongs to the model.
    pub(crate) on_wall: f64,
    /// 0.25: spacing of samples on outlines, walls and between strands.
    pub(crate) outline_step: f64,
    /// 1: a loop that misses more than this counts as a loop with wall missing.
    pub(crate) missed: f64,
    /// 0.15: outline further than w/2 and this from every bead gets no clay.
    pub(crate) uncovered: f64,
    /// 0.05: the outline is thin where it lies further than w/2 and this from the largest possible wall path.
    pub(crate) thin_beyond: f64,
    /// 0.02: thin places narrower than twice this are rounding.
    pub(crate) thin_opening: f64,
    /// 0.3: how far round a thin place the strand still counts as its wall.
    pub(crate) thin_reach: f64,
    /// 0.25: a strand is inside or outside of the wall when its centre lies this far from the wall path.
    pub(crate) beside: f64,
    /// 1: a strand that runs less than this along the wall between outside and inside goes through it.
    pub(crate) passage: f64,
    /// 2: clay on clay this near to where the strand leaves or joins the wall belongs to the root.
    pub(crate) root: f64,
    /// 3: how far into the layer its cycle may begin, after the step from the layer below.
    pub(crate) head: f64,
    /// 0.02: spacing of the samples on that step.
    pub(crate) head_step: f64,
    /// 0.05: a cycle is closed when its end comes this near to its beginning.
    pub(crate) closed: f64,
    /// 0.03: a step shorter than this is no step.
    pub(crate) step_up: f64,
    /// 0.02: what the file's rounding may add to `ε_across`.
    pub(crate) held: f64,
    /// 0.05: the same at the one point where a layer begins.
    pub(crate) start_held: f64,
    /// 1.2: the longest step from the end of one layer to the beginning of the next.
    pub(crate) seam: f64,
}

impl Tolerance {
    pub(crate) fn for_width(width: f64) -> Self {
        let unit = width / REFERENCE_WIDTH;
        Self {
            laid: 0.12 * unit,
            on_wall: 0.1 * unit,
            outline_step: 0.25 * unit,
            missed: unit,
            uncovered: 0.15 * unit,
            thin_beyond: 0.05 * unit,
            thin_opening: 0.02 * unit,
            thin_reach: 0.3 * unit,
            beside: 0.25 * unit,
            passage: unit,
            root: 2.0 * unit,
            head: 3.0 * unit,
            head_step: 0.02 * unit,
            closed: 0.05 * unit,
            step_up: 0.03 * unit,
            held: 0.02 * unit,
            start_held: 0.05 * unit,
            seam: 1.2 * unit,
        }
    }
}
