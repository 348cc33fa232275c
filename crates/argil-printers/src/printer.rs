//! Printers.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::fact::within;
use crate::{Fact, ProfileError};

/// The bundled printers, as name and TOML, by name.
#[must_use]
pub fn printers() -> &'static [(&'static str, &'static str)] {
    &[
        ("eazao-m500", include_str!("../printers/eazao-m500.toml")),
        ("eazao-m600", include_str!("../printers/eazao-m600.toml")),
        ("eazao-potter", include_str!("../printers/eazao-potter.toml")),
        ("eazao-zero", include_str!("../printers/eazao-zero.toml")),
        ("generic-klipper", include_str!("../printers/generic-klipper.toml")),
        ("generic-marlin", include_str!("../printers/generic-marlin.toml")),
        ("generic-reprapfirmware", include_str!("../printers/generic-reprapfirmware.toml")),
        ("lutum-4-6", include_str!("../printers/lutum-4-6.toml")),
        ("potterbot-10-xl", include_str!("../printers/potterbot-10-xl.toml")),
        ("potterbot-micro", include_str!("../printers/potterbot-micro.toml")),
        ("potterbot-super-10", include_str!("../printers/potterbot-super-10.toml")),
        ("robot-cell", include_str!("../printers/robot-cell.toml")),
        ("tronxy-moore-1", include_str!("../printers/tronxy-moore-1.toml")),
        ("tronxy-moore-2-pro", include_str!("../printers/tronxy-moore-2-pro.toml")),
        ("wasp-2040-clay", include_str!("../printers/wasp-2040-clay.toml")),
        ("wasp-40100-ldm", include_str!("../printers/wasp-40100-ldm.toml")),
    ]
}

/// The space that a printer can reach, mm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged, deny_unknown_fields)]
pub enum Volume {
    /// A box.
    Box {
        /// Along x.
        x: f64,
        /// Along y.
        y: f64,
        /// Upwards.
        z: f64,
    },
    /// A cylinder, as deltas have it.
    Round {
        /// Across.
        diameter: f64,
        /// Upwards.
        z: f64,
    },
}

/// Where x = y = 0 is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Origin {
    /// At a corner of the bed; x and y are positive on it.
    Corner,
    /// In the middle of the bed.
    Centre,
}

/// What language the printer reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Flavour {
    /// Marlin's g-code.
    Marlin,
    /// That of `RepRapFirmware`.
    RepRapFirmware,
    /// Klipper's.
    Klipper,
    /// A neutral table of poses.
    Poses,
}

/// The cross-section by which the printer's users reckon paste.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Bead {
    /// Width times height.
    Box,
    /// With round sides.
    Rounded,
}

/// A printer. Lengths in mm, speeds in mm/s.
///
/// # Example
/// ```
/// use argil_printers::{Bead, Fact, Flavour, Origin, Printer, ProfileError, Volume};
/// let bundled = Printer::bundled("generic-marlin").expect("it is bundled")?;
/// // The same with a bed of one's own; a file of one's own is read by `from_toml`.
/// let own = Printer {
///     volume: Fact::Known { value: Volume::Box { x: 200.0, y: 200.0, z: 300.0 }, source: "argil".into(), note: None },
///     origin: Fact::Known { value: Origin::Corner, source: "argil".into(), note: None },
///     ..bundled.clone()
/// };
/// assert_eq!((own.middle(), own.reaches([20.0; 3], [180.0; 3])), (Some([100.0; 2]), Some(true)));
/// assert_eq!(own.reaches([-20.0; 3], [180.0; 3]), Some(false));
/// assert_eq!(bundled.reaches([20.0; 3], [180.0; 3]), None);
/// assert_eq!((own.flavour.value(), own.bead.value()), (Some(&Flavour::Marlin), Some(&Bead::Rounded)));
/// assert!(matches!(Printer::from_toml("name = 7"), Err(ProfileError::Toml(_))));
/// # Ok::<(), ProfileError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Printer {
    /// The name by which people know it.
    pub name: String,
    /// What moves: cartesian, delta, robot.
    pub kind: String,
    /// Where sources contradict each other, and which was taken.
    #[serde(default)]
    pub contradictions: Vec<String>,
    /// The space that it can reach.
    pub volume: Fact<Volume>,
    /// The middle of that space, where it is not half of it from the corner.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub middle: Option<Fact<[f64; 2]>>,
    /// Where x = y = 0 is.
    pub origin: Fact<Origin>,
    /// What language it reads.
    pub flavour: Fact<Flavour>,
    /// Paste in mm³ that one unit of E pushes out. E is millimetres of a virtual filament, of a plunger, or a factor of
    /// length, but this one number covers all of them.
    pub mm3_per_e: Fact<f64>,
    /// Whether each E is the amount of its own move (M83) or counted up (M82).
    pub relative_e: Fact<bool>,
    /// The cross-section by which paste is reckoned.
    pub bead: Fact<Bead>,
    /// Nozzles that it comes with, across.
    pub nozzles: Fact<Vec<f64>>,
    /// Bead width in use.
    pub width: Fact<f64>,
    /// Layer height in use.
    pub layer_height: Fact<f64>,
    /// Speed while extruding.
    pub feed: Fact<f64>,
    /// Speed on the lowest layer.
    pub first_layer_feed: Fact<f64>,
    /// Speed without extruding.
    pub travel_feed: Fact<f64>,
    /// Code before the strand, a [template](crate::render).
    pub start: Fact<String>,
    /// Code after the strand, a [template](crate::render).
    pub end: Fact<String>,
    /// Volumetric E: the diameter of the filament that M200 is to name. E is in mm³ then.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub volumetric_diameter: Option<Fact<f64>>,
    /// For machines that push paste at a constant rate without E: the rate, mm³/s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub constant_rate: Option<Fact<f64>>,
    /// What the sources' short names stand for.
    pub sources: BTreeMap<String, String>,
}

impl Printer {
    /// Reads a printer's profile.
    ///
    /// # Errors
    /// Text that is no profile, a value from a source that is not listed, or a number that cannot be.
    pub fn from_toml(text: &str) -> Result<Self, ProfileError> {
        let printer: Self = toml::from_str(text)?;
        printer.check()?;
        Ok(printer)
    }

    /// The bundled printer of a name, if there is one.
    ///
    /// # Errors
    /// None with the profiles as they are, which tests hold.
    #[must_use]
    pub fn bundled(name: &str) -> Option<Result<Self, ProfileError>> {
        let (_, text) = printers().iter().find(|(known, _)| *known == name)?;
        Some(Self::from_toml(text))
    }

    /// The middle of the bed, if it is known.
    #[must_use]
    pub fn middle(&self) -> Option<[f64; 2]> {
        let told = self.middle.as_ref().and_then(Fact::value).copied();
        told.or_else(|| self.middle_of_volume())
    }

    fn middle_of_volume(&self) -> Option<[f64; 2]> {
        match (self.origin.value()?, self.volume.value()?) {
            (Origin::Centre, _) => Some([0.0, 0.0]),
            (Origin::Corner, Volume::Box { x, y, .. }) => Some([x / 2.0, y / 2.0]),
            (Origin::Corner, Volume::Round { diameter, .. }) => Some([diameter / 2.0; 2]),
        }
    }

    /// Whether a box from `low` to `high` lies in the printer's space; `None` if that is not known.
    #[must_use]
    pub fn reaches(&self, low: [f64; 3], high: [f64; 3]) -> Option<bool> {
        let ([mx, my], volume) = (self.middle()?, self.volume.value()?);
        let far = |k: usize, middle: f64| (low[k] - middle).abs().max((high[k] - middle).abs());
        let (x, y) = (far(0, mx), far(1, my));
        Some(match *volume {
            Volume::Box { x: wide, y: deep, z } => x <= wide / 2.0 && y <= deep / 2.0 && high[2] <= z,
            Volume::Round { diameter, z } => x.hypot(y) <= diameter / 2.0 && high[2] <= z,
        })
    }

    fn check(&self) -> Result<(), ProfileError> {
        let Self { sources, .. } = self;
        self.volume.check_source("volume", sources)?;
        self.middle.iter().try_for_each(|fact| fact.check_source("middle", sources))?;
        self.origin.check_source("origin", sources)?;
        self.flavour.check_source("flavour", sources)?;
        self.relative_e.check_source("relative_e", sources)?;
        self.bead.check_source("bead", sources)?;
        self.nozzles.check_source("nozzles", sources)?;
        self.start.check_source("start", sources)?;
        self.end.check_source("end", sources)?;
        let mut numbers = vec![
            ("mm3_per_e", &self.mm3_per_e),
            ("width", &self.width),
            ("layer_height", &self.layer_height),
            ("feed", &self.feed),
            ("first_layer_feed", &self.first_layer_feed),
            ("travel_feed", &self.travel_feed),
        ];
        numbers.extend(self.volumetric_diameter.iter().map(|fact| ("volumetric_diameter", fact)));
        numbers.extend(self.constant_rate.iter().map(|fact| ("constant_rate", fact)));
        for (field, fact) in numbers {
            fact.check_source(field, sources)?;
            within(field, fact.value(), 1e-3, 1e5, "between 0.001 and 100,000")?;
        }
        for nozzle in self.nozzles.value().into_iter().flatten() {
            within("nozzles", Some(nozzle), 1e-3, 1e3, "between 0.001 and 1000 mm")?;
        }
        let lengths = match self.volume.value() {
            Some(Volume::Box { x, y, z }) => vec![*x, *y, *z],
            Some(Volume::Round { diameter, z }) => vec![*diameter, *z],
            None => vec![],
        };
        lengths.iter().try_for_each(|v| within("volume", Some(v), 1.0, 1e6, "between 1 and 1,000,000 mm"))?;
        let mut middle = self.middle.as_ref().and_then(Fact::value).into_iter().flatten();
        middle.try_for_each(|v| within("middle", Some(v), -1e6, 1e6, "between -1,000,000 and 1,000,000 mm"))
    }
}
