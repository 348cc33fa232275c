use std::fmt;

/// Something of a file that was not taken as it stands, although it could be read.
///
/// # Example
/// ```
/// use argil_mesh::{Format, Remark, Soup};
/// let mut bytes = Soup::cuboid([0.0; 3], [1.0; 3]).to_stl();
/// // A program that writes triangles as they come, and never returns to their number.
/// bytes[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
/// let soup = Format::Stl.read(&bytes)?;
/// assert_eq!(soup.remarks, [Remark::Count { declared: u64::from(u32::MAX), present: 12 }]);
/// # Ok::<(), argil_mesh::MeshError>(())
/// ```
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
