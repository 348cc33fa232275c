//! What machines understand differently.

use std::fmt;

/// A family of firmware, for what not every one of them can do.
///
/// # Example
/// ```
/// use argil_gcode::Flavour;
/// assert!(Flavour::Marlin.knows_volumetric() && !Flavour::Klipper.knows_volumetric());
/// assert_eq!(Flavour::RepRapFirmware.to_string(), "RepRapFirmware");
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Flavour {
    /// Marlin and its descendants. E is kept in single precision.
    #[default]
    Marlin,
    /// `RepRapFirmware`.
    RepRapFirmware,
    /// Klipper. It has no volumetric E, and reads arcs only where its configuration has a section `gcode_arcs`.
    Klipper,
}

impl Flavour {
    /// Whether the firmware takes E in mm³ after M200.
    #[must_use]
    pub const fn knows_volumetric(self) -> bool {
        !matches!(self, Flavour::Klipper)
    }

    /// The flavour's name as its makers write it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Flavour::Marlin => "Marlin",
            Flavour::RepRapFirmware => "RepRapFirmware",
            Flavour::Klipper => "Klipper",
        }
    }
}

impl fmt::Display for Flavour {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// How paste is asked for.
///
/// # Example
/// ```
/// use argil_gcode::{Extrusion, FILAMENT_1_75, GcodeSettings, strand};
/// use strand::{BeadShape, DVec2, Move, Role, Strand, StrandLayer};
/// let mut settings = GcodeSettings { mm3_per_e: 6.4, ..GcodeSettings::default() };
/// assert_eq!(settings.paste_per_e(), 6.4);
/// settings.extrusion = Extrusion::Volumetric { diameter: FILAMENT_1_75 };
/// assert_eq!(settings.paste_per_e(), 1.0);
/// // What pushes without being told is fast where the bead is thin.
/// let there_and_back = [(9.0, 0.0), (0.0, 0.0)].map(|at| Move { to: at.into(), role: Role::Wall });
/// let layer = StrandLayer { index: 0, z: 0.5, height: 0.5, width: 1.5, moves: there_and_back.into(), supports: vec![] };
/// let strand = Strand::new(DVec2::ZERO, vec![layer])?;
/// settings = GcodeSettings { extrusion: Extrusion::Constant { rate: 15.0 }, bead: BeadShape::Box, ..settings };
/// assert_eq!(settings.speed(&strand, 0), 20.0);
/// assert!(strand.steps().all(|step| settings.speed_of(&strand, &step) == 20.0));
/// # Ok::<(), strand::StrandError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Extrusion {
    /// By E, of which one unit pushes out [`mm3_per_e`](crate::GcodeSettings::mm3_per_e).
    #[default]
    Units,
    /// By E in mm³, which the firmware divides by the cross-section of a filament of this diameter in mm (M200 before
    /// the strand, M200 D0 after it). `mm3_per_e` is 1 then, whatever is set.
    Volumetric {
        /// Diameter of the filament that the firmware reckons with, mm.
        diameter: f64,
    },
    /// Not at all: paste comes at a constant rate in mm³/s, and the speed alone keeps beads at their width. Moves have
    /// no E, so [`read_gcode`](crate::read_gcode) takes them for travel.
    Constant {
        /// Paste in mm³/s.
        rate: f64,
    },
}

/// Text whose code lines get a number and a checksum, for machines at the end of an unreliable line.
///
/// A line is `N`, its number, the code without its comment, `*`, and the bytes before the star joined by exclusive or.
/// Lines of comments alone stay as they are. The count is set to 0 first (M110).
pub(crate) struct Numbered<'t>(pub(crate) &'t str);

impl fmt::Display for Numbered<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut number = 0u64;
        for line in self.0.lines() {
            let code = line.split(';').next().unwrap_or("").trim();
            if code.is_empty() {
                writeln!(f, "{line}")?;
                continue;
            }
            if number == 0 {
                checked(f, "N0 M110 N0")?;
            }
            number += 1;
            checked(f, &format!("N{number} {code}"))?;
        }
        Ok(())
    }
}

fn checked(f: &mut fmt::Formatter<'_>, line: &str) -> fmt::Result {
    let sum = line.bytes().fold(0, |sum, byte| sum ^ byte);
    writeln!(f, "{line}*{sum}")
}

#[cfg(test)]
mod tests {
    use super::Numbered;

    #[test]
    fn code_is_numbered_and_comments_are_not() {
        let text = ";TYPE:Custom\nT0\nG92 E0 ; from here\n\nG28\n";
        let wanted = ";TYPE:Custom\nN0 M110 N0*125\nN1 T0*59\nN2 G92 E0*69\n\nN3 G28*16\n";
        assert_eq!(Numbered(text).to_string(), wanted);
    }
}
