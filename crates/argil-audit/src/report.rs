//! The report: figures, findings, and what they fall short of.

use crate::settings::Tolerance;
use crate::{Amount, AuditSettings, ContactCause, ContactPlace, Figures, Finding, FindingKind};
use std::collections::BTreeMap;
use std::fmt;

/// How many findings of a kind the text shows.
const SHOWN: usize = 5;

/// The share of the wall that may lack a bead: rounding at sharp corners.
const MISSED: f64 = 0.002;

/// What the audit found.
///
/// # Example
/// ```
/// use argil_audit::{Amount, AuditSettings, Report, audit, gcode::read_gcode, mesh::Mesh};
/// let plate = Mesh::cuboid([0.0; 3], [20.0, 20.0, 0.5])?;
/// let square = "M83\nG0 X.75 Y.75 Z.5\nG1 X19.25 E1\nG1 Y19.25 E1\nG1 X.75 E1\nG1 Y.75 E1\n";
/// let report: Report = audit(&read_gcode(square), &plate, &AuditSettings::default())?;
/// assert!(report.is_sound(), "{report}");
/// assert!(report.figures.entries().contains(&("layers", Amount::Count(1))));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Report {
    /// What was asked for.
    pub settings: AuditSettings,
    /// The figures.
    pub figures: Figures,
    /// Every fault and point of interest: those of the motion first, then layer by layer.
    pub findings: Vec<Finding>,
    /// Every place where non-model strand touches the model outside, the lowest first: what to clean, and where roots
    /// are to be cut.
    pub contacts: Vec<ContactPlace>,
}

/// A figure that is not what it must be.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Shortfall {
    /// Name of the figure in [`Figures`].
    pub figure: &'static str,
    /// Its value.
    pub value: f64,
    /// What it may be at most; at least, for too few layers.
    pub limit: f64,
}

impl Report {
    /// Whether this is a strictly continuous, self-supported print of the whole model.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        self.falls_short().is_empty()
    }

    /// Every figure that misses its limit.
    #[must_use]
    pub fn falls_short(&self) -> Vec<Shortfall> {
        let f = &self.figures;
        let count = |n: usize| n as f64;
        let limits = [
            ("transfer_moves", count(f.transfer_moves), 0.0),
            ("retractions", count(f.retractions), 0.0),
            ("z_down_moves", count(f.z_down_moves), 0.0),
            ("bad_lines", count(f.bad_lines), 0.0),
            ("open_layers", count(f.open_layers), 0.0),
            ("paths_per_layer_max", count(f.paths_per_layer_max), 1.0),
            ("model_missed_fraction", f.model_missed_fraction, MISSED),
            ("unsupported_spans", count(f.unsupported_spans), 0.0),
            ("self_crossings", count(f.self_crossings), 0.0),
            ("wall_crossings", count(f.wall_crossings), 0.0),
            ("seam_gap_max_mm", f.seam_gap_max_mm, Tolerance::for_width(self.settings.tolerance_width).seam),
            ("seam_starts_unsupported", count(f.seam_starts_unsupported), 0.0),
        ];
        let mut short: Vec<Shortfall> = limits
            .into_iter()
            .filter(|&(_, value, limit)| value > limit)
            .map(|(figure, value, limit)| Shortfall { figure, value, limit })
            .collect();
        let most = f.mesh_layers + 1;
        if f.layers < f.wanted_layers || f.layers > most {
            let limit = if f.layers < f.wanted_layers { f.wanted_layers } else { most };
            short.push(Shortfall { figure: "layers", value: count(f.layers), limit: count(limit) });
        }
        short
    }

    /// The findings of one kind.
    pub fn findings_of(&self, kind: FindingKind) -> impl Iterator<Item = &Finding> {
        self.findings.iter().filter(move |finding| finding.kind == kind)
    }

    /// Number and length in mm of the places of contact by cause, in the order of [`ContactCause`].
    ///
    /// [`ContactCause`]: crate::ContactCause
    #[must_use]
    pub fn contacts_by_cause(&self) -> Vec<(ContactCause, usize, f64)> {
        let mut causes: BTreeMap<ContactCause, (usize, f64)> = BTreeMap::new();
        for place in &self.contacts {
            let (count, length) = causes.entry(place.cause).or_default();
            *count += 1;
            *length += place.length;
        }
        causes.into_iter().map(|(cause, (count, length))| (cause, count, length)).collect()
    }

    fn write_contacts(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (cause, count, length) in self.contacts_by_cause() {
            writeln!(f, "touches the model, {} ({count} places, {length:.1} mm):", cause.name())?;
            let mut places: Vec<&ContactPlace> = self.contacts.iter().filter(|p| p.cause == cause).collect();
            places.sort_by(|a, b| b.length.total_cmp(&a.length));
            for place in places.iter().take(SHOWN) {
                let ContactPlace { first_layer, last_layer, at, length, .. } = place;
                writeln!(
                    f,
                    "    layers {first_layer} to {last_layer} at {:.2} {:.2}: {length:.2}",
                    at.x, at.y
                )?;
            }
        }
        Ok(())
    }

    fn worst_of(&self, kind: FindingKind) -> Vec<&Finding> {
        let mut worst: Vec<&Finding> = self.findings_of(kind).collect();
        worst.sort_by(|a, b| b.measure.total_cmp(&a.measure));
        worst
    }
}

impl fmt::Display for Report {
    /// One figure a line, then the worst findings of each kind, the largest places of contact, and the verdict.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (name, amount) in self.figures.entries() {
            match amount {
                Amount::Count(count) => writeln!(f, "{name:<33} {count}")?,
                Amount::Measure(measure) => writeln!(f, "{name:<33} {measure:.4}")?,
            }
        }
        let mut kinds: Vec<FindingKind> = self.findings.iter().map(|finding| finding.kind).collect();
        kinds.sort_unstable();
        kinds.dedup();
        for kind in kinds {
            let worst = self.worst_of(kind);
            writeln!(f, "{} ({}):", kind.name(), worst.len())?;
            for finding in worst.iter().take(SHOWN) {
                write!(f, "    layer {}", finding.layer)?;
                if let Some(at) = finding.at {
                    write!(f, " at {:.2} {:.2}", at.x, at.y)?;
                }
                writeln!(f, ": {:.2}", finding.measure)?;
            }
        }
        self.write_contacts(f)?;
        let short = self.falls_short();
        if short.is_empty() {
            return write!(f, "sound");
        }
        write!(f, "short of:")?;
        for (k, s) in short.iter().enumerate() {
            let separator = if k == 0 { "" } else { ";" };
            write!(f, "{separator} {} = {:.4} (limit {})", s.figure, s.value, s.limit)?;
        }
        Ok(())
    }
}

#[cfg(feature = "serde")]
impl serde::Serialize for Report {
    /// The verdict and what it rests on are written with the rest, so that the text can be read by itself.
    fn serialize<S: serde::Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct;
        let mut report = to.serialize_struct("Report", 6)?;
        report.serialize_field("sound", &self.is_sound())?;
        report.serialize_field("falls_short", &self.falls_short())?;
        report.serialize_field("settings", &self.settings)?;
        report.serialize_field("figures", &self.figures)?;
        report.serialize_field("findings", &self.findings)?;
        report.serialize_field("contacts", &self.contacts)?;
        report.end()
    }
}

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for Report {
    /// The verdict is drawn anew from settings and figures, whatever the text says.
    fn deserialize<D: serde::Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        #[derive(serde::Deserialize)]
        struct Measured {
            settings: AuditSettings,
            figures: Figures,
            findings: Vec<Finding>,
            contacts: Vec<ContactPlace>,
        }
        let Measured { settings, figures, findings, contacts } = Measured::deserialize(from)?;
        Ok(Self { settings, figures, findings, contacts })
    }
}
