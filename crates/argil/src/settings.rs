//! What the user decides.

use argil_elastic::ElasticOptions;
use argil_route::RouteSettings;
use argil_safeguard::SafeguardSettings;
use argil_seam::SeamSettings;
use argil_slice::SliceSettings;
use argil_support::{Criterion, Placement};
use argil_taut::TautOptions;

use crate::PlanError;

/// What a paste bears, measured by test prints; both in bead widths w.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Material {
    /// `ε_across` / w: how far a bead may lie beside the one below. The paper measured 0.3 for Laguna clay with 33 % water.
    pub across: f64,
    /// `ε_along` / w: the longest bridge along the path. The paper measured 1.6.
    pub along: f64,
}

impl Default for Material {
    /// The paper's clay.
    fn default() -> Self {
        Self { across: 0.3, along: 1.6 }
    }
}

/// What is laid inside of the walls, beside floors and skins.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Infill {
    /// Nothing: what has to be held inside is held by strand from the walls.
    #[default]
    None,
    /// Lanes all over, of so large a share of clay: above 0, at most 1.
    Ratio(f64),
    /// Lanes below what is filled, as dense and as far down as it needs to be held, or nothing: whichever makes the shorter strand. Both
    /// are planned.
    Auto,
}

/// Turns on the bed round the lowest layer, laid before it and without a break: paste comes evenly when the part begins.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Skirt {
    /// How often it goes round. More steady the flow and take more paste.
    pub turns: usize,
    /// From the lowest layer's strand to the innermost turn, middle to middle, in w.
    pub distance: f64,
    /// The bed that it must stay on, if it is known: where there is not enough room the skirt comes nearer, then has fewer turns,
    /// and at last is left out.
    #[cfg_attr(feature = "serde", serde(default))]
    pub bed: Option<Bed>,
}

impl Default for Skirt {
    /// Two turns at three bead widths, on a bed of any size.
    fn default() -> Self {
        Self { turns: 2, distance: 3.0, bed: None }
    }
}

/// Which of several walls side by side is laid first.
///
/// # Example
/// ```
/// use argil::{Planner, Settings, WallOrder, mesh::Mesh};
/// let tube = Mesh::cuboid([0.0; 3], [30.0, 30.0, 4.0])?;
/// let settings = Settings { walls: 2, wall_order: WallOrder::OuterLast, ..Settings::for_width(2.0) };
/// let plan = Planner::default().plan(&tube, &settings)?;
/// assert!(plan.layers.iter().all(|layer| layer.outer_ahead.is_some_and(|share| share < 0.1)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum WallOrder {
    /// None: layers begin where the step from the one below is shortest and least seen.
    #[default]
    Any,
    /// The outermost, as far as a start allows that a short step leads to: its bead is laid beside nothing, where it is wanted.
    OuterFirst,
    /// The outermost last: its bead leans on the others.
    OuterLast,
}

/// What of the bed the nozzle reaches, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Bed {
    /// A rectangle along the axes.
    Rectangle {
        /// The corner with the least coordinates.
        low: [f64; 2],
        /// The corner with the greatest.
        high: [f64; 2],
    },
    /// A disc.
    Disc {
        /// Its middle.
        middle: [f64; 2],
        /// Its radius.
        radius: f64,
    },
}

/// Settings of a plan. Everything that is not here follows from these, in proportion to the bead width.
///
/// # Example
/// ```
/// use argil::{Material, Settings};
/// let stiff = Material { across: 0.35, ..Material::default() };
/// let settings = Settings { walls: 2, material: stiff, ..Settings::for_width(3.0) };
/// assert_eq!(settings.layer_height, 1.0);
/// assert!((settings.criterion().across - 1.05).abs() < 1e-12); // mm
/// // What each stage gets follows.
/// assert_eq!((settings.slicing().walls, settings.slicing().layer_height), (2, 1.0));
/// let across = settings.criterion().across;
/// assert_eq!((settings.routing().across, settings.safeguarding().shrink), (across, across));
/// assert_eq!((settings.tautening().across, settings.seaming().across), (across, across));
/// assert!(settings.smoothing().envelope < across);
/// assert!(settings.check().is_ok());
/// assert!(Settings { walls: 0, ..settings }.check().is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Settings {
    /// Bead width w, mm (paper: 1.5, from a 0.6 mm nozzle).
    pub width: f64,
    /// Layer height h, mm (paper: 0.5).
    pub layer_height: f64,
    /// How many walls lie side by side along every outline.
    pub walls: usize,
    /// Which of them comes first.
    #[cfg_attr(feature = "serde", serde(default))]
    pub wall_order: WallOrder,
    /// How many of the lowest layers are filled whole.
    #[cfg_attr(feature = "serde", serde(default))]
    pub floor: usize,
    /// How many layers close each face that looks up or down and is wider than a bead.
    #[cfg_attr(feature = "serde", serde(default))]
    pub skin: usize,
    /// Whether the layers rise evenly along their cycles wherever they can, so that no step is left between them: a spiral. The
    /// path stays the same in the plane.
    #[cfg_attr(feature = "serde", serde(default))]
    pub spiral: bool,
    /// Turns on the bed before the part, in the same strand.
    #[cfg_attr(feature = "serde", serde(default))]
    pub skirt: Option<Skirt>,
    /// Whether rings of floors and skins that lie in each other without a branch become double spirals, which hardly turn back.
    #[cfg_attr(feature = "serde", serde(default))]
    pub spirals: bool,
    /// Whether beads of fill are all w wide. If not, they are as wide as there is room for between their neighbours, from 0.75 w to 1.33 w.
    #[cfg_attr(feature = "serde", serde(default))]
    pub even_flow: bool,
    /// What is laid inside of the walls.
    #[cfg_attr(feature = "serde", serde(default))]
    pub infill: Infill,
    /// Whether the mesh is a sheet without thickness, as for vases in a spiral: its sections are the walls' paths themselves. It has one wall;
    /// it may have a floor, but neither skins nor infill, since nobody knows which side of it is inside.
    #[cfg_attr(feature = "serde", serde(default))]
    pub surface: bool,
    /// What the paste bears.
    pub material: Material,
    /// Step of the output coordinates, mm. Planning rounds to it before the last checks.
    pub grid: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self::for_width(1.5)
    }
}

/// Longest step from one layer to the next, in w. Where a strand ends on the wall below it, the start has to get from
/// its tip to its root in one step, so short limits leave domes without a chain; 0.8 is what is measured against.
const REACH: f64 = 0.79;

/// Radius of the disc about a point that needs support, as a share of `ε_across`. The strand may pass anywhere in it;
/// what is left of `ε_across` becomes a held length along the strand, so that points can lie farther apart.
const ENVELOPE: f64 = 0.65;

/// Share of what the paste bears that sparse fill relies on, as support does.
const HELD: f64 = 0.95;

/// How much of the envelope demands may use up when they are moved before smoothing.
const SLACK: f64 = 0.9;

/// `α_l` of Eq. 2. With the paper's 0.9 strands die slowly, and lanes that a lower one draws together are parted again when the path
/// is pulled taut. Strand beside the model at 0.7, 0.5 and 0.3: gargoyle 0.47, 0.44, 0.42, thinker 0.22, 0.20, 0.19, bunny
/// 0.39, 0.38, 0.36 of the model's length.
const TENSION: f64 = 0.3;

/// `μ_bend` of Eq. 3 in w². Less than the elastic stage's own 0.133, which suits the paper's tension: softer tips retract
/// faster. It saved a twentieth to a tenth on two models of three and cost as much on the third.
const STIFFNESS: f64 = 0.05;

/// Floors and skins of more layers than this are solid parts, or a mistake.
const MOST_CLOSED: usize = 1000;

/// More turns of a skirt than this are a mistake.
const MOST_TURNS: usize = 100;

/// The least distance of a skirt, in w: nearer, and it is hard to part from the part.
pub(crate) const NEAREST_SKIRT: f64 = 1.5;

impl Settings {
    /// Defaults for a bead width: a third of it as layer height, one wall, the paper's clay.
    #[must_use]
    pub fn for_width(width: f64) -> Self {
        Self {
            width,
            layer_height: width / 3.0,
            walls: 1,
            wall_order: WallOrder::Any,
            floor: 0,
            skin: 0,
            spiral: false,
            skirt: None,
            spirals: false,
            even_flow: false,
            infill: Infill::None,
            surface: false,
            material: Material::default(),
            grid: 1e-4,
        }
    }

    /// Refuses values that no plan can be made with.
    ///
    /// # Errors
    /// [`PlanError::Setting`] names the first one.
    pub fn check(&self) -> Result<(), PlanError> {
        let positive = [
            ("width", self.width),
            ("layer_height", self.layer_height),
            ("grid", self.grid),
            ("material.across", self.material.across),
            ("material.along", self.material.along),
        ];
        for (name, value) in positive {
            if !(value > 0.0 && value.is_finite()) {
                return Err(PlanError::Setting { name, value, expected: "positive and finite" });
            }
        }
        let at_most = [
            ("layer_height", self.layer_height, self.width, "at most the width: a bead is wider than high"),
            ("material.across", self.material.across, 1.0, "at most 1: beyond that beads do not touch"),
            ("grid", self.grid, 1e-3 * self.width, "at most a thousandth of the width"),
        ];
        for (name, value, limit, expected) in at_most {
            if value > limit {
                return Err(PlanError::Setting { name, value, expected });
            }
        }
        if self.walls == 0 || self.walls > 100 {
            return Err(PlanError::Setting { name: "walls", value: self.walls as f64, expected: "1 to 100" });
        }
        if self.spiral && self.wall_order != WallOrder::Any {
            let expected = "left out in a spiral, whose layers begin where the one below ends";
            return Err(PlanError::Setting { name: "wall_order", value: 1.0, expected });
        }
        if let Infill::Ratio(value) = self.infill
            && !(value > 0.0 && value <= 1.0)
        {
            return Err(PlanError::Setting { name: "infill", value, expected: "above 0 and at most 1" });
        }
        let for_solids = [("walls", self.walls.saturating_sub(1)), ("skin", self.skin)];
        if let Some((name, _)) = for_solids.into_iter().find(|&(_, asked)| self.surface && asked > 0) {
            let value = if name == "walls" { self.walls } else { self.skin } as f64;
            return Err(PlanError::Setting {
                name,
                value,
                expected: "left out for a sheet without thickness",
            });
        }
        if self.surface && self.infill != Infill::None {
            let value = if let Infill::Ratio(share) = self.infill { share } else { 1.0 };
            let expected = "left out for a sheet without thickness";
            return Err(PlanError::Setting { name: "infill", value, expected });
        }
        for (name, value) in [("floor", self.floor), ("skin", self.skin)] {
            if value > MOST_CLOSED {
                return Err(PlanError::Setting { name, value: value as f64, expected: "at most 1000" });
            }
        }
        if let Some(Skirt { turns, distance, .. }) = self.skirt {
            if turns == 0 || turns > MOST_TURNS {
                return Err(PlanError::Setting {
                    name: "skirt.turns",
                    value: turns as f64,
                    expected: "1 to 100",
                });
            }
            if !(NEAREST_SKIRT..=1e4).contains(&distance) {
                let expected = "1.5 to 10,000 bead widths";
                return Err(PlanError::Setting { name: "skirt.distance", value: distance, expected });
            }
        }
        Ok(())
    }

    /// `ε_across` and `ε_along` in mm: what must hold of the finished path.
    #[must_use]
    pub fn criterion(&self) -> Criterion {
        Criterion { across: self.material.across * self.width, along: self.material.along * self.width }
    }

    /// What the slice stage gets.
    #[must_use]
    pub fn slicing(&self) -> SliceSettings {
        SliceSettings {
            layer_height: self.layer_height,
            width: self.width,
            walls: self.walls,
            grid: self.grid,
            surface: self.surface,
            ..SliceSettings::default()
        }
    }

    /// What the safeguard stage gets.
    #[must_use]
    pub fn safeguarding(&self) -> SafeguardSettings {
        SafeguardSettings { shrink: self.criterion().across, ..SafeguardSettings::for_width(self.width) }
    }

    /// What the support stage gets: the criterion with a margin in hand.
    #[must_use]
    pub fn support(&self) -> Placement {
        Placement::for_criterion(self.width, &self.criterion())
    }

    /// What the route stage gets.
    #[must_use]
    pub fn routing(&self) -> RouteSettings {
        RouteSettings {
            across: self.criterion().across,
            slack: SLACK * self.envelope(),
            grid: self.grid,
            ..RouteSettings::for_width(self.width)
        }
    }

    /// What the smoothing stage gets.
    #[must_use]
    pub fn smoothing(&self) -> ElasticOptions {
        ElasticOptions {
            envelope: self.envelope(),
            target_ratio: TENSION,
            bend: STIFFNESS,
            ..ElasticOptions::for_width(self.width)
        }
    }

    /// What the tautening stage gets.
    #[must_use]
    pub fn tautening(&self) -> TautOptions {
        let Criterion { across, along } = self.criterion();
        TautOptions { across, along, ..TautOptions::for_width(self.width) }
    }

    /// What the seam stage gets.
    #[must_use]
    pub fn seaming(&self) -> SeamSettings {
        SeamSettings {
            across: self.criterion().across,
            reach: REACH * self.width,
            ..SeamSettings::for_width(self.width)
        }
    }

    /// Lanes so far apart hold what lies across them: it bridges the gap, but for what either lane holds beside itself.
    pub(crate) fn bridged(&self) -> f64 {
        let Criterion { across, along } = self.criterion();
        (HELD * (along + 2.0 * across)).max(self.width)
    }

    /// How far an end of a lane may lie beyond the one below, mm.
    pub(crate) fn retreat(&self) -> f64 {
        HELD * self.criterion().across
    }

    /// How far a strand may pass from a point that it supports, mm.
    pub(crate) fn envelope(&self) -> f64 {
        ENVELOPE * self.criterion().across
    }
}
