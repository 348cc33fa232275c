use std::fmt;

/// Something of a file that was not taken as it stands, although it could be read.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Remark {
    /// The header of a binary STL declares fewer triangles than whole ones follow, or the largest number there is, as
    /// programs write that do not know the count yet; all that follow were read.
    Count {
        /// The count in the header.
        declared: u64,
        /// How many whole triangles follow it.
        present: u64,
    },
    /// Objects of a 3MF file that are no part of the model, as supports of another program, were left out.
    Aids {
        /// How many.
        count: usize,
    },
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Count { declared, present } => {
                write!(f, "the header declares {declared} triangles; all {present} that follow were read")
            }
            Self::Aids { count } => write!(f, "{count} objects that are no part of the model were left out"),
        }
    }
}
