use std::fmt;

/// Something of a file that was not taken as it stands, although it could be read.
#[derive(Clone, Debug, PartialEq, Eq)]
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
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Count { declared, present } => {
                write!(f, "the header declares {declared} triangles; all {present} that follow were read")
            }
        }
    }
}
