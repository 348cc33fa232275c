//! A value that says where it comes from, or that it is unknown.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::ProfileError;

/// A value with its source, or the statement that none is known.
///
/// In TOML: `feed = { value = 25, source = "cura", note = "10 to 40" }` or `feed = { unknown = "no source gives it" }`.
///
/// # Example
/// ```
/// use argil_printers::{Fact, Material, materials};
/// for (name, _) in materials() {
///     let paste = Material::bundled(name).expect("it is bundled")?;
///     let feed: &Fact<f64> = &paste.feed;
///     assert!(feed.origin().is_some() || feed.unknown().is_some());
///     assert_eq!(feed.value().is_some(), feed.origin().is_some());
/// }
/// # Ok::<(), argil_printers::ProfileError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged, deny_unknown_fields)]
pub enum Fact<T> {
    /// Known from somewhere.
    Known {
        /// The value.
        value: T,
        /// Key of the source in the profile's table of sources.
        source: String,
        /// What has to be known about the value.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        note: Option<String>,
    },
    /// Not known.
    Unknown {
        /// Why, or what to do about it.
        unknown: String,
    },
}

impl<T> Fact<T> {
    /// The value, if it is known.
    #[must_use]
    pub fn value(&self) -> Option<&T> {
        match self {
            Self::Known { value, .. } => Some(value),
            Self::Unknown { .. } => None,
        }
    }

    /// Why the value is unknown, if it is.
    #[must_use]
    pub fn unknown(&self) -> Option<&str> {
        match self {
            Self::Known { .. } => None,
            Self::Unknown { unknown } => Some(unknown),
        }
    }

    /// Where it comes from and what has to be known about it, if it is known.
    #[must_use]
    pub fn origin(&self) -> Option<(&str, Option<&str>)> {
        match self {
            Self::Known { source, note, .. } => Some((source, note.as_deref())),
            Self::Unknown { .. } => None,
        }
    }

    /// Refuses a value whose source is not listed.
    pub(crate) fn check_source(
        &self,
        field: &'static str,
        sources: &BTreeMap<String, String>,
    ) -> Result<(), ProfileError> {
        match self.origin() {
            Some((source, _)) if !sources.contains_key(source) => {
                Err(ProfileError::Source { field, source_name: source.to_owned() })
            }
            _ => Ok(()),
        }
    }
}

/// Refuses numbers outside of a range; what is no number is outside as well.
pub(crate) fn within(
    field: &'static str,
    value: Option<&f64>,
    low: f64,
    high: f64,
    must_be: &'static str,
) -> Result<(), ProfileError> {
    match value {
        Some(&value) if !(value >= low && value <= high) => {
            Err(ProfileError::Number { field, value, must_be })
        }
        _ => Ok(()),
    }
}
