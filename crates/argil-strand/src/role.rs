//! What a stretch of the strand is laid for.

use std::fmt;

/// What a stretch of the strand is laid for.
///
/// The order of the variants is the order in which reports list them.
///
/// # Example
/// ```
/// use argil_strand::Role;
/// let of_the_model = Role::ALL.into_iter().filter(|role| role.is_model());
/// assert_eq!(of_the_model.map(Role::name).collect::<Vec<_>>(), ["wall", "fill"]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
#[non_exhaustive]
pub enum Role {
    /// A model path: the bead becomes the surface of the part.
    Wall,
    /// A non-model path that passes support points of the layer above.
    Support,
    /// A non-model path that only joins other stretches: the price of never lifting.
    Connection,
    /// The step that rises from the end of one layer to the start of the next.
    Seam,
    /// A bead inside the part or closing it: floors, roofs, further walls.
    Fill,
    /// Turns on the bed round the lowest layer, before its cycle: the flow steadies itself on them. They are thrown away.
    Skirt,
}

impl Role {
    /// Every role, in the order in which reports list them.
    pub const ALL: [Role; 6] =
        [Role::Wall, Role::Support, Role::Connection, Role::Seam, Role::Fill, Role::Skirt];

    /// The role's name in lower case, as in reports and files.
    ///
    /// ```
    /// assert_eq!(argil_strand::Role::Wall.name(), "wall");
    /// ```
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Role::Wall => "wall",
            Role::Support => "support",
            Role::Connection => "connection",
            Role::Seam => "seam",
            Role::Fill => "fill",
            Role::Skirt => "skirt",
        }
    }

    /// Whether the bead stays in the part: walls and fill do, all else is cut away after printing.
    #[must_use]
    pub const fn is_model(self) -> bool {
        matches!(self, Role::Wall | Role::Fill)
    }

    /// Position in [`Role::ALL`].
    pub(crate) const fn position(self) -> usize {
        self as usize
    }
}

impl fmt::Display for Role {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::Role;

    #[test]
    fn positions_follow_the_list_of_all_roles() {
        for (k, role) in Role::ALL.into_iter().enumerate() {
            assert_eq!(role.position(), k);
        }
    }
}
