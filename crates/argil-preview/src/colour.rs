//! The colours of roles and marks.

use std::fmt;

use argil_strand::Role;

/// Roles from the lowest coat of paint to the uppermost: the part's surface must not be hidden.
pub(crate) const COATS: [Role; 6] =
    [Role::Skirt, Role::Connection, Role::Support, Role::Fill, Role::Wall, Role::Seam];

/// A colour of the screen (sRGB).
///
/// # Example
/// ```
/// use argil_preview::Colour;
/// let grey = Colour::new(0, 0, 0).towards(Colour::WHITE, 0.5);
/// assert_eq!(grey.to_string(), "#808080");
/// assert_eq!(Colour::DARK.to_string(), "#2b2320");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Colour {
    /// Share of red.
    pub red: u8,
    /// Share of green.
    pub green: u8,
    /// Share of blue.
    pub blue: u8,
}

impl Colour {
    /// White.
    pub const WHITE: Colour = Colour::new(255, 255, 255);
    /// A warm black for marks and outlines: pure black is harsher than clay.
    pub const DARK: Colour = Colour::new(43, 35, 32);

    /// The colour of three shares.
    #[must_use]
    pub const fn new(red: u8, green: u8, blue: u8) -> Self {
        Self { red, green, blue }
    }

    /// The colour on the way to another: this one at 0, the other at 1.
    #[must_use]
    pub fn towards(self, other: Colour, share: f64) -> Colour {
        let share = share.clamp(0.0, 1.0);
        // A float becomes a byte by saturation, and what is not a number becomes 0.
        let mix = |a: u8, b: u8| (f64::from(a) + (f64::from(b) - f64::from(a)) * share).round() as u8;
        Colour::new(mix(self.red, other.red), mix(self.green, other.green), mix(self.blue, other.blue))
    }
}

impl fmt::Display for Colour {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "#{:02x}{:02x}{:02x}", self.red, self.green, self.blue)
    }
}

/// One colour for each role.
///
/// The default is terracotta for what stays in the part (fill paler than walls), slate blue for support and ochre for
/// connections, a stony grey for the skirt: apart in hue and in lightness, so that they also differ to most colour-blind eyes and in grey.
///
/// # Example
/// ```
/// use argil_preview::{Colour, Palette, strand::Role};
/// let palette = Palette { support: Colour::WHITE, ..Palette::default() };
/// assert_eq!(palette.of(Role::Support), Colour::WHITE);
/// assert_ne!(palette.of(Role::Wall), palette.of(Role::Connection));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct Palette {
    /// For walls.
    pub wall: Colour,
    /// For support.
    pub support: Colour,
    /// For connections.
    pub connection: Colour,
    /// For seam steps.
    pub seam: Colour,
    /// For fill.
    pub fill: Colour,
    /// For the skirt.
    pub skirt: Colour,
}

impl Default for Palette {
    fn default() -> Self {
        Self {
            wall: Colour::new(0xc6, 0x6b, 0x4b),
            support: Colour::new(0x6c, 0x88, 0xa3),
            connection: Colour::new(0xd9, 0xa9, 0x4e),
            seam: Colour::new(0x8a, 0x4a, 0x6b),
            fill: Colour::new(0xe0, 0xa9, 0x8e),
            skirt: Colour::new(0xb9, 0xb2, 0xa6),
        }
    }
}

impl Palette {
    /// The colour of a role.
    #[must_use]
    pub fn of(&self, role: Role) -> Colour {
        match role {
            Role::Wall => self.wall,
            Role::Connection => self.connection,
            Role::Seam => self.seam,
            Role::Fill => self.fill,
            Role::Skirt => self.skirt,
            // Roles added later are drawn like what is cut away until they have a colour of their own.
            _ => self.support,
        }
    }
}
