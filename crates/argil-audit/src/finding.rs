//! One fault or point of interest, with its place.

use argil_curve::DVec2;

/// What was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum FindingKind {
    /// A line that the reader could not make sense of; the measure is its number in the file.
    UnreadableLine,
    /// A move in the plane that lays no clay; the measure is its length, mm.
    Transfer,
    /// Material drawn back; the measure is the amount in the file's unit of E.
    Retraction,
    /// A move down; the measure is the descent, mm.
    MoveDown,
    /// A layer of several paths; the measure is their number.
    ManyPaths,
    /// A layer whose end does not come back to its beginning; the measure is the distance between them, mm.
    OpenLayer,
    /// A layer of the model with walls of which the file has nothing; the measure is their length, mm.
    MissingLayer,
    /// A stretch of wall path without a bead; the measure is its length, mm.
    MissedWall,
    /// A stretch longer than the longest bridge with nothing below; the measure is its length, mm.
    UnsupportedSpan,
    /// A place where the path goes through itself; the measure is 1.
    SelfCrossing,
    /// A place where the path goes through the wall; the measure is 1.
    WallCrossing,
    /// A step between layers that is too long; the measure is its length, mm.
    SeamGap,
    /// A layer that begins with nothing below; the measure is the distance to the nearest bead below, mm.
    UnsupportedStart,
    /// A sharp turn of non-model strand; the measure is its angle in degrees.
    SharpTurn,
    /// Turns of non-model strand that add up within half a bead; the measure is their angle in degrees.
    SharpBend,
    /// A stretch of outline longer than a bead that no bead reaches, since the model is thinner there; the measure is
    /// its length, mm.
    BareOutline,
    /// A place of a floor or face that is to be closed, farther than 0.55 beads from the middle of every bead; the measure is
    /// that distance, mm.
    BareFill,
    /// A stretch of non-model strand that holds nothing, joins nothing and lies away from the strand above; the measure
    /// is the length farther than one bead from that, mm.
    Jump,
    /// Non-model strand that touches the wall from outside apart from its roots: a place to be cleaned. The
    /// measure is its length, mm.
    Contact,
}

impl FindingKind {
    /// The name used in reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::UnreadableLine => "unreadable line",
            Self::Transfer => "transfer move",
            Self::Retraction => "retraction",
            Self::MoveDown => "move down",
            Self::ManyPaths => "several paths",
            Self::OpenLayer => "open layer",
            Self::MissingLayer => "missing layer",
            Self::MissedWall => "missed wall",
            Self::UnsupportedSpan => "unsupported span",
            Self::SelfCrossing => "self crossing",
            Self::WallCrossing => "wall crossing",
            Self::SeamGap => "seam gap",
            Self::UnsupportedStart => "unsupported start",
            Self::SharpTurn => "sharp turn",
            Self::SharpBend => "sharp bend",
            Self::BareOutline => "bare outline",
            Self::BareFill => "open place in a floor or face",
            Self::Jump => "jump",
            Self::Contact => "contact",
        }
    }
}

/// One fault or point of interest.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Finding {
    /// What was found.
    pub kind: FindingKind,
    /// The layer, by the file's own number.
    pub layer: i64,
    /// Where in the plane, mm: the middle of a stretch, the beginning of a move. `None` for what has no one
    /// place.
    pub at: Option<DVec2>,
    /// How much, in the unit that the kind tells.
    pub measure: f64,
}
