use std::fmt;

/// A unit of length that model files are made in.
///
/// # Example
/// ```
/// use argil_mesh::Unit;
/// assert_eq!(Unit::named("inch").map(Unit::millimetres), Some(25.4));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Unit {
    /// 0.001 mm.
    Micron,
    /// 1 mm.
    Millimetre,
    /// 10 mm.
    Centimetre,
    /// 25.4 mm.
    Inch,
    /// 304.8 mm.
    Foot,
    /// 1,000 mm.
    Metre,
}

impl Unit {
    /// The unit of this name, as [`Display`](fmt::Display) writes it.
    ///
    /// # Example
    /// ```
    /// use argil_mesh::Unit;
    /// assert_eq!((Unit::named("cm"), Unit::named("ell")), (Some(Unit::Centimetre), None));
    /// ```
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Some(match name {
            "micron" => Self::Micron,
            "mm" => Self::Millimetre,
            "cm" => Self::Centimetre,
            "inch" => Self::Inch,
            "foot" => Self::Foot,
            "m" => Self::Metre,
            _ => return None,
        })
    }

    /// How many millimetres it has.
    #[must_use]
    pub fn millimetres(self) -> f64 {
        match self {
            Self::Micron => 1e-3,
            Self::Millimetre => 1.0,
            Self::Centimetre => 10.0,
            Self::Inch => 25.4,
            Self::Foot => 304.8,
            Self::Metre => 1e3,
        }
    }

    /// The unit that a file of this largest extent is likely to be in, if that is not millimetres: the largest extent
    /// of what is printed lies between 10 mm and 3 m. It is a hint for people and never acted upon.
    ///
    /// # Example
    /// ```
    /// use argil_mesh::Unit;
    /// assert_eq!(Unit::hint(120.0), None);
    /// assert_eq!(Unit::hint(0.2), Some(Unit::Metre));
    /// assert_eq!(Unit::hint(4.5), Some(Unit::Inch));
    /// assert_eq!(Unit::hint(90_000.0), Some(Unit::Micron));
    /// ```
    #[must_use]
    pub fn hint(extent: f64) -> Option<Self> {
        match extent {
            extent if extent <= 0.0 => None,
            extent if extent < 1.0 => Some(Self::Metre),
            extent if extent < 10.0 => Some(Self::Inch),
            extent if extent > 5e3 => Some(Self::Micron),
            _ => None,
        }
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Micron => "micron",
            Self::Millimetre => "mm",
            Self::Centimetre => "cm",
            Self::Inch => "inch",
            Self::Foot => "foot",
            Self::Metre => "m",
        })
    }
}
