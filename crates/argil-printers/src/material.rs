//! Pastes.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::fact::within;
use crate::{Fact, ProfileError};

/// The bundled materials, as name and TOML, by name.
#[must_use]
pub fn materials() -> &'static [(&'static str, &'static str)] {
    &[
        ("concrete", include_str!("../materials/concrete.toml")),
        ("earthenware", include_str!("../materials/earthenware.toml")),
        ("laguna", include_str!("../materials/laguna.toml")),
        ("moore-clay", include_str!("../materials/moore-clay.toml")),
        ("porcelain", include_str!("../materials/porcelain.toml")),
        ("silicone", include_str!("../materials/silicone.toml")),
        ("stoneware", include_str!("../materials/stoneware.toml")),
    ]
}

/// A paste.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// The name by which people know it.
    pub name: String,
    /// Where sources contradict each other, and which was taken.
    #[serde(default)]
    pub contradictions: Vec<String>,
    /// Density while printing, g/cm³.
    pub density: Fact<f64>,
    /// How far a wall may lean out, degrees from the vertical.
    pub overhang: Fact<f64>,
    /// The longest bridge along the strand, bead widths.
    pub bridge: Fact<f64>,
    /// Bead width in use, mm.
    pub width: Fact<f64>,
    /// Layer height in use, mm.
    pub layer_height: Fact<f64>,
    /// Speed in use, mm/s.
    pub feed: Fact<f64>,
    /// Linear shrinkage from wet to fired, per cent: least and most.
    pub shrinkage: Fact<[f64; 2]>,
    /// Of it, while drying, per cent. Shares are no sum: the total is 1 − (1 − drying)(1 − firing).
    pub drying: Fact<[f64; 2]>,
    /// Of it, while firing, per cent of the dry length.
    pub firing: Fact<[f64; 2]>,
    /// What the sources' short names stand for.
    pub sources: BTreeMap<String, String>,
}

impl Material {
    /// Reads a material's profile.
    ///
    /// # Errors
    /// Text that is no profile, a value from a source that is not listed, or a number that cannot be.
    ///
    /// # Example
    /// ```
    /// use argil_printers::{Material, materials};
    /// let (_, text) = materials().iter().find(|(name, _)| *name == "stoneware").ok_or("not bundled")?;
    /// let own = Material::from_toml(&text.replacen("name = ", "name = 'Own ' # ", 1))?;
    /// assert_eq!(own.name, "Own ");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn from_toml(text: &str) -> Result<Self, ProfileError> {
        let material: Self = toml::from_str(text)?;
        material.check()?;
        Ok(material)
    }

    /// The bundled material of a name, if there is one.
    ///
    /// # Errors
    /// None with the profiles as they are, which tests hold.
    #[must_use]
    pub fn bundled(name: &str) -> Option<Result<Self, ProfileError>> {
        let (_, text) = materials().iter().find(|(known, _)| *known == name)?;
        Some(Self::from_toml(text))
    }

    /// How far a bead may lie beside the one below, in bead widths, for beads of a width and layers of a height: the
    /// tangent of the overhang times the height, by the width. `None` if the overhang is not known.
    ///
    /// ```
    /// let laguna = argil_printers::Material::bundled("laguna").unwrap()?;
    /// assert!((laguna.across(1.5, 0.5).unwrap() - 0.3).abs() < 1e-3);
    /// # Ok::<(), argil_printers::ProfileError>(())
    /// ```
    #[must_use]
    pub fn across(&self, width: f64, height: f64) -> Option<f64> {
        self.overhang.value().map(|degrees| degrees.to_radians().tan() * height / width)
    }

    fn check(&self) -> Result<(), ProfileError> {
        let sources = &self.sources;
        for (field, fact, high, must_be) in [
            ("density", &self.density, 30.0, "between 0.001 and 30 g/cm³"),
            ("overhang", &self.overhang, 89.0, "between 0.001 and 89 degrees"),
            ("bridge", &self.bridge, 100.0, "between 0.001 and 100 widths"),
            ("width", &self.width, 1e4, "between 0.001 and 10,000 mm"),
            ("layer_height", &self.layer_height, 1e4, "between 0.001 and 10,000 mm"),
            ("feed", &self.feed, 1e5, "between 0.001 and 100,000 mm/s"),
        ] {
            fact.check_source(field, sources)?;
            within(field, fact.value(), 1e-3, high, must_be)?;
        }
        for (field, fact) in
            [("shrinkage", &self.shrinkage), ("drying", &self.drying), ("firing", &self.firing)]
        {
            fact.check_source(field, sources)?;
            if let Some([least, most]) = fact.value() {
                within(field, Some(least), 0.0, *most, "the least first, then the most")?;
                within(field, Some(most), 0.0, 60.0, "between 0 and 60 per cent")?;
            }
        }
        Ok(())
    }
}
