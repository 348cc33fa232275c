//! What can be wrong with a profile.

/// Why a profile or a template cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ProfileError {
    /// The text is no TOML, or not that of a profile.
    #[error("{0}")]
    Toml(#[from] toml::de::Error),
    /// A value names a source that the profile does not list.
    #[error("{field}: its source `{source_name}` is not listed under [sources]")]
    Source {
        /// The field.
        field: &'static str,
        /// The name of the source.
        source_name: String,
    },
    /// A number that cannot be.
    #[error("{field} = {value}: must be {must_be}")]
    Number {
        /// The field.
        field: &'static str,
        /// Its value.
        value: f64,
        /// What is accepted.
        must_be: &'static str,
    },
    /// A template has a name in braces that stands for nothing.
    #[error("template: {{{name}}} is not one of {known}")]
    Variable {
        /// The name.
        name: String,
        /// The names that there are.
        known: String,
    },
    /// A template has a brace without its other half.
    #[error("template: a brace is open at `{at}`; {{{{ and }}}} stand for braces themselves")]
    Brace {
        /// Where: the rest of the line.
        at: String,
    },
}
