//! What the writer must be told about machine, paste and viewer.

use argil_strand::{BeadShape, Role, Step, Strand};

use crate::{Extrusion, Flavour, GcodeError};

/// Volume in mm³ of one mm of filament of 1.75 mm, the unit of E that most firmwares and viewers assume.
///
/// PrusaSlicer's viewer derives bead widths from E with this diameter, and the clay printers of Eazao count so.
pub const FILAMENT_1_75: f64 = std::f64::consts::PI * 1.75 * 1.75 / 4.0;

/// The thinnest bead that a constant rate of paste is spread for, as a share of the layer's height.
const THINNEST: f64 = 0.25;

/// The word that a viewer knows for each role, written after `;TYPE:`.
///
/// No vocabulary is known to all viewers: PrusaSlicer colours its own words only, Cura logs foreign ones and shows the
/// type before. The words are therefore data, with the three common vocabularies at hand. The words of roles other
/// than fill keep clear of `fill`, `skin`, `top`, `bottom`, `floor` and `roof`, those of roles other than skirt of `skirt`, `prime`
/// and `purge`: tools that measure g-code read these as solid surfaces and as extras beside the part.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct RoleNames {
    /// For [`Role::Wall`].
    pub wall: String,
    /// For [`Role::Support`].
    pub support: String,
    /// For [`Role::Connection`]: drawn apart from support wherever the viewer has a second support colour.
    pub connection: String,
    /// For [`Role::Seam`].
    pub seam: String,
    /// For [`Role::Fill`].
    pub fill: String,
    /// For [`Role::Skirt`].
    pub skirt: String,
}

impl Default for RoleNames {
    /// [`RoleNames::prusa_slicer`]: its viewer draws beads of clay at their width, Cura's draws any bead wider
    /// than 1.2 mm as a thread of 0.35 mm.
    fn default() -> Self {
        Self::prusa_slicer()
    }
}

impl RoleNames {
    fn of_words([wall, support, connection, seam, fill, skirt]: [&str; 6]) -> Self {
        let own = str::to_owned;
        Self {
            wall: own(wall),
            support: own(support),
            connection: own(connection),
            seam: own(seam),
            fill: own(fill),
            skirt: own(skirt),
        }
    }

    /// The words of PrusaSlicer's g-code viewer.
    #[must_use]
    pub fn prusa_slicer() -> Self {
        let words = ["External perimeter", "Support material", "Support material interface", "Custom"];
        Self::of_words([words[0], words[1], words[2], words[3], "Solid infill", "Skirt/Brim"])
    }

    /// The words of Cura's viewer, which many web viewers understand too.
    #[must_use]
    pub fn cura() -> Self {
        Self::of_words(["WALL-OUTER", "SUPPORT", "SUPPORT-INTERFACE", "WALL-INNER", "FILL", "SKIRT"])
    }

    /// The words of OrcaSlicer's g-code viewer.
    ///
    /// # Example
    /// ```
    /// use argil_gcode::{RoleNames, strand::Role};
    /// assert_eq!(RoleNames::default(), RoleNames::prusa_slicer());
    /// assert_eq!(RoleNames::orca_slicer().name(Role::Wall), "Outer wall");
    /// assert_eq!(RoleNames::cura().role("SUPPORT"), Some(Role::Support));
    /// ```
    #[must_use]
    pub fn orca_slicer() -> Self {
        let words = ["Outer wall", "Support", "Support interface", "Custom"];
        Self::of_words([words[0], words[1], words[2], words[3], "Internal solid infill", "Skirt"])
    }

    /// The word for a role.
    #[must_use]
    pub fn name(&self, role: Role) -> &str {
        match role {
            Role::Wall => &self.wall,
            Role::Connection => &self.connection,
            Role::Seam => &self.seam,
            Role::Fill => &self.fill,
            Role::Skirt => &self.skirt,
            // Roles added later are not part of the model until they are given a word of their own.
            _ => &self.support,
        }
    }

    /// The role that a word stands for, whatever its case; `None` for words of another vocabulary.
    ///
    /// ```
    /// use argil_gcode::RoleNames;
    /// use argil_gcode::strand::Role;
    /// assert_eq!(RoleNames::cura().role("wall-outer"), Some(Role::Wall));
    /// assert_eq!(RoleNames::cura().role("Brim"), None);
    /// ```
    #[must_use]
    pub fn role(&self, word: &str) -> Option<Role> {
        Role::ALL.into_iter().find(|&role| self.name(role).eq_ignore_ascii_case(word))
    }
}

/// How a strand is written as g-code.
///
/// # Example
/// ```
/// use argil_gcode::{Extrusion, Flavour, GcodeError, GcodeSettings};
/// let klipper = GcodeSettings { flavour: Flavour::Klipper, relative_e: false, ..GcodeSettings::default() };
/// assert_eq!(klipper.check(), Ok(()));
/// // Klipper knows no E in mm³.
/// let volumetric = GcodeSettings { extrusion: Extrusion::Volumetric { diameter: 1.75 }, ..klipper };
/// assert!(matches!(volumetric.check(), Err(GcodeError::Dialect { flavour: Flavour::Klipper, .. })));
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct GcodeSettings {
    /// Decimals of coordinates in mm. Default 4, the grid of 1e-4 mm on which plans are checked: with fewer, the
    /// written path is not the checked one. At most 6.
    pub decimals: u8,
    /// Decimals of E. `None`, the default, takes 5 or as many as one grid step of the thinnest bead needs to
    /// extrude (at most 9): machines whose E counts mm of a wide plunger need more. With fewer than needed, points
    /// are passed over until E is more than nothing.
    pub e_decimals: Option<u8>,
    /// Each E is the amount of its own move (M83), the default. Otherwise E is counted up through each layer (M82) and set
    /// back to 0 between layers, since firmware keeps it in single precision.
    pub relative_e: bool,
    /// Paste in mm³ that one unit of E pushes out. Default [`FILAMENT_1_75`]. Machines differ: 6.38 for a filament
    /// of 2.85 mm, 1 under volumetric E, the plunger's cross-section where E is its travel.
    pub mm3_per_e: f64,
    /// The firmware, for what not every one can do. Default Marlin.
    pub flavour: Flavour,
    /// How paste is asked for. Default by E in units of `mm3_per_e`.
    pub extrusion: Extrusion,
    /// Arcs (G2, G3) in place of short moves wherever both are nowhere farther apart than this, mm. Default `None`: every
    /// move is straight, and what is written is what was checked.
    pub arc_tolerance: Option<f64>,
    /// Whether every line of code has a number and a checksum. Default false.
    pub line_numbers: bool,
    /// Cross-section of a bead, for E. The default is rounded; the full rectangle lays 8 % more at 1.5 mm × 0.5 mm.
    pub bead: BeadShape,
    /// Speed while extruding, mm/s. Default 25, the middle of what clay printers' makers give (15 to 40).
    pub feed: f64,
    /// Speed on the lowest layer, mm/s. Default 15: it must stick to the bed, and makers give 10 to 20.
    pub first_layer_feed: f64,
    /// Speed before the first and after the last extrusion, mm/s. Default 25.
    pub approach_feed: f64,
    /// How far above the first point the nozzle comes in, and above the last it leaves, mm. Default 5.
    pub lift: f64,
    /// How far the nozzle goes on along the cycle of the uppermost layer, without E, before it leaves, mm: what still comes out
    /// is wiped off on strand that lies there. At most once round. Default 0.
    pub wipe: f64,
    /// What is said to have made the file. Default: the name and version of argil. Some viewers change their reading
    /// when they find their own name here.
    pub generator: String,
    /// Lines `; key = value` at the top, in this order: the settings that the part was planned with.
    pub header: Vec<(String, String)>,
    /// Lines of comment below the header, verbatim: a thumbnail. Each begins with `;`. Default none.
    pub preface: Vec<String>,
    /// The vocabulary of `;TYPE:` comments.
    pub names: RoleNames,
    /// Machine code before everything else, verbatim: homing, priming, M302 P1 where firmware refuses to extrude
    /// cold (not written unasked: a machine with a heated nozzle would grind its filament). Default empty. The
    /// writer sets units and modes after it, so it need not.
    pub start: String,
    /// Machine code after the final lift, verbatim. Default empty.
    pub end: String,
}

impl Default for GcodeSettings {
    fn default() -> Self {
        Self {
            decimals: 4,
            e_decimals: None,
            relative_e: true,
            mm3_per_e: FILAMENT_1_75,
            flavour: Flavour::default(),
            extrusion: Extrusion::default(),
            arc_tolerance: None,
            line_numbers: false,
            bead: BeadShape::Rounded,
            feed: 25.0,
            first_layer_feed: 15.0,
            approach_feed: 25.0,
            lift: 5.0,
            wipe: 0.0,
            generator: format!("argil {}", env!("CARGO_PKG_VERSION")),
            header: Vec::new(),
            preface: Vec::new(),
            names: RoleNames::default(),
            start: String::new(),
            end: String::new(),
        }
    }
}

impl GcodeSettings {
    /// Paste in mm³ that one unit of E stands for in the file.
    #[must_use]
    pub fn paste_per_e(&self) -> f64 {
        match self.extrusion {
            Extrusion::Volumetric { .. } => 1.0,
            _ => self.mm3_per_e,
        }
    }

    /// Speed on a layer, mm/s: as set, or what a constant rate of paste asks for. The layer is counted from the lowest;
    /// above the uppermost the speed is that of other layers.
    #[must_use]
    pub fn speed(&self, strand: &Strand, layer: usize) -> f64 {
        match (self.extrusion, strand.layers().get(layer)) {
            (Extrusion::Constant { rate }, Some(laid)) => rate / self.bead.area(laid.width, laid.height),
            _ if layer == 0 => self.first_layer_feed,
            _ => self.feed,
        }
    }

    /// Speed on a step of the strand, mm/s: that of its layer, or, where a constant rate of paste meets a bead of another height or width
    /// than its layer's, what that bead asks for. Beads thinner than a quarter of the layer are laid as if they were that thick, since
    /// their speed would have no limit.
    #[must_use]
    pub fn speed_of(&self, strand: &Strand, step: &Step) -> f64 {
        match (self.extrusion, strand.layers().get(step.layer)) {
            (Extrusion::Constant { rate }, Some(laid)) => {
                rate / self.bead.area(step.width, step.height.max(THINNEST * laid.height))
            }
            _ => self.speed(strand, step.layer),
        }
    }

    /// Refuses numbers that cannot be written or would not extrude, and comments that would be read as others. Writers
    /// call it themselves.
    ///
    /// # Errors
    /// The first setting that will not do.
    pub fn check(&self) -> Result<(), GcodeError> {
        let within = |name, value: f64, low: f64, high: f64, must_be| {
            let fits = value >= low && value <= high;
            if fits { Ok(()) } else { Err(GcodeError::Setting { name, value, must_be }) }
        };
        within("decimals", f64::from(self.decimals), 0.0, 6.0, "at most 6")?;
        within("e_decimals", f64::from(self.e_decimals.unwrap_or(5)), 0.0, 9.0, "at most 9")?;
        within("mm3_per_e", self.mm3_per_e, 1e-6, 1e6, "between 1e-6 and 1e6 mm³")?;
        within("lift", self.lift, 0.0, 1e6, "between 0 and 1e6 mm")?;
        within("wipe", self.wipe, 0.0, 1e6, "between 0 and 1e6 mm")?;
        within("arc_tolerance", self.arc_tolerance.unwrap_or(0.0), 0.0, 1e3, "between 0 and 1000 mm")?;
        match self.extrusion {
            Extrusion::Units => {}
            Extrusion::Volumetric { diameter } => {
                within("diameter", diameter, 1e-3, 1e3, "between 0.001 and 1000 mm")?;
                if !self.flavour.knows_volumetric() {
                    return Err(GcodeError::Dialect { flavour: self.flavour, lacks: "volumetric E (M200)" });
                }
            }
            Extrusion::Constant { rate } => within("rate", rate, 1e-3, 1e9, "between 0.001 and 1e9 mm³/s")?,
        }
        for (name, value) in [
            ("feed", self.feed),
            ("first_layer_feed", self.first_layer_feed),
            ("approach_feed", self.approach_feed),
        ] {
            within(name, value, 1e-3, 1e6, "between 0.001 and 1e6 mm/s")?;
        }
        for (key, value) in &self.header {
            check_comment(key)?;
            check_comment(value)?;
            let plain = |c: char| c.is_ascii_alphanumeric() || " _-.[]".contains(c);
            if key.trim().is_empty() || !key.chars().all(plain) {
                let why = "a key is made of letters, digits, blanks and _ - . [ ]";
                return Err(GcodeError::Comment { text: key.clone(), why });
            }
            if key.trim().to_ascii_uppercase().starts_with("LAYER_CHANGE") {
                return Err(GcodeError::Comment {
                    text: key.clone(),
                    why: "it would be read as a new layer",
                });
            }
        }
        for line in &self.preface {
            check_comment(line)?;
            if !line.starts_with(';') {
                return Err(GcodeError::Comment { text: line.clone(), why: "it does not begin with ;" });
            }
        }
        check_comment(&self.generator)?;
        Role::ALL.into_iter().try_for_each(|role| check_comment(self.names.name(role)))
    }
}

/// A comment ends with its line, so text with line ends would go on as code.
fn check_comment(text: &str) -> Result<(), GcodeError> {
    if text.chars().any(char::is_control) {
        return Err(GcodeError::Comment { text: text.to_owned(), why: "it holds a control character" });
    }
    Ok(())
}
