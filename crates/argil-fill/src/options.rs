//! How a region is filled.

use crate::FillError;

/// How rings become one curve.
///
/// # Example
/// ```
/// use argil_fill::{Figures, FillOptions, FillPattern, fill};
/// use geo_types::{MultiPolygon, polygon};
/// let plate = polygon![(x: 0.0, y: 0.0), (x: 30.0, y: 0.0), (x: 30.0, y: 20.0), (x: 0.0, y: 20.0)];
/// let figures = |pattern| -> Result<Figures, argil_fill::FillError> {
///     let options = FillOptions { pattern, ..FillOptions::for_width(1.5) };
///     Ok(fill(&MultiPolygon(vec![plate.clone()]), &[], &options, &[])?.figures)
/// };
/// // What runs round and round has fewer places where rings are joined.
/// assert!(figures(FillPattern::Spirals)?.rings < figures(FillPattern::Rings)?.rings);
/// # Ok::<(), argil_fill::FillError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum FillPattern {
    /// Ring by ring, each joined to a neighbour by two legs.
    #[default]
    Rings,
    /// Rings that lie in each other without a branch as one double spiral (a Fermat spiral), which turns back only at its two ends; the others
    /// ring by ring. A disc has a fifth of the sharp turns, and somewhat more stays bare at the ends of the spiral.
    Spirals,
}

/// How a region is filled. Lengths are in mm where they say so, else in w, the bead width.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct FillOptions {
    /// Bead width w, mm. Rings are one width apart.
    pub width: f64,
    /// How many of the outermost rings are walls: a joint may take no more than [`wall_cut`](Self::wall_cut) out of
    /// them, since their beads are what is seen and what was asked for. 0 where walls come from elsewhere.
    pub walls: usize,
    /// What a joint takes out of a wall, in w. A tenth is less than a bead's rounding hides.
    pub wall_cut: f64,
    /// The longest joint, in w. Rings are one width apart; the rest is for necks and residue loops.
    pub reach: f64,
    /// A strip that stays bare between rings gets a loop there and back if a disc of this diameter fits into it, in w.
    /// A lower value closes floors at the price of doubled clay, a higher one spares clay: at 0.6 instead of 0.4 the
    /// prototype left half a per cent less covered for one per cent less doubled.
    pub residue: f64,
    /// Bare discs wider than this are reported, and mended by a detour of the nearest strand if possible and if they are wider than
    /// [`residue`](Self::residue), too; in w. Below 0.25 none can be mended: the rounded ends of a joint leave as much.
    pub bare: f64,
    /// Rounds of mending; 0 mends nothing.
    pub mending: usize,
    /// The narrowest and the widest bead, in w, where beads follow the room that they have: [`FillCurve::flow`](crate::FillCurve::flow) and
    /// the figures then say what is laid. From 0.75 to 1.33 a strip of three beads that has four lanes, none of them a wall, has hardly
    /// more clay than room. `None` for one width everywhere.
    pub flow: Option<[f64; 2]>,
    /// How rings become one curve.
    pub pattern: FillPattern,
    /// Step of the output coordinates, mm.
    pub grid: f64,
}

/// A region of a thousand beads across is a mistake in units.
pub(crate) const MOST_RINGS: usize = 20_000;

impl FillOptions {
    /// The options that serve most regions at bead width `width`; see the fields for their reasons.
    #[must_use]
    pub fn for_width(width: f64) -> Self {
        Self {
            width,
            walls: 1,
            wall_cut: 0.1,
            reach: 2.25,
            residue: 0.4,
            bare: 0.33,
            mending: 3,
            flow: None,
            pattern: FillPattern::Rings,
            grid: 1e-4,
        }
    }

    pub(crate) fn check(&self) -> Result<(), FillError> {
        let [narrowest, widest] = self.flow.unwrap_or([1.0; 2]);
        let within = [
            ("width", self.width, f64::MIN_POSITIVE, 1e6, "positive and at most a kilometre"),
            ("wall_cut", self.wall_cut, 0.02, 1.0, "from 0.02 to 1"),
            ("reach", self.reach, 1.0, 10.0, "from 1 to 10"),
            ("residue", self.residue, 0.05, f64::MAX, "at least 0.05"),
            ("bare", self.bare, 0.05, f64::MAX, "at least 0.05"),
            ("flow", narrowest, 0.1, 1.0, "from 0.1 to 1 for the narrowest bead"),
            ("flow", widest, 1.0, 3.0, "from 1 to 3 for the widest bead"),
            (
                "grid",
                self.grid,
                f64::MIN_POSITIVE,
                1e-3 * self.width,
                "positive, at most a thousandth of the width",
            ),
        ];
        for (name, value, least, most, expected) in within {
            if !(least..=most).contains(&value) {
                return Err(FillError::Option { name, value, expected });
            }
        }
        Ok(())
    }
}

impl Default for FillOptions {
    /// A bead of 1.5 mm, as in the paper.
    fn default() -> Self {
        Self::for_width(1.5)
    }
}
