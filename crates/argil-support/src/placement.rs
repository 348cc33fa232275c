//! How support points are placed: the limits to plan with and what a point is worth.

use crate::Criterion;

/// Share of `ε_across` that the path below may pass beside a point that needs support. What is left holds a stretch
/// either side of the point. 0.65 gave the shortest strands in the prototype's runs: with 0.5 the points are
/// fewer, but the path below has too little freedom to use it.
const SLACK: f64 = 0.65;

/// Share of either limit to plan with. The rest is for rounding to the output grid and for strands moved by
/// less than it.
const MARGIN: f64 = 0.95;

/// Of the 5 % of `ε_along` that the margin keeps back, the share that goes to either side of a point within a
/// long run. Two of them leave 1 % of `ε_along` between the planned gap and the true limit.
const RETURNED: f64 = 0.02;

/// How [`place_supports`](crate::place_supports) places points. All lengths in mm.
///
/// The fields are tied to each other: with `slack` the distance at which a path may pass a needed point, ε
/// the true limits of the paste and the values of [`with_slack`](Self::with_slack), every path that passes
/// within `slack` of every need satisfies the [`Criterion`] exactly. That holds as long as
/// - `across` ≤ `ε_across`,
/// - `cover` ≤ `ε_across` − `slack`: what a strand below that is off by `slack` still holds either side of a
///   need,
/// - `along` + 2 `held` − 2 `cover` ≤ `ε_along`,
/// - `share` ≤ `slack`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Placement {
    /// A point nearer than this to a wall of the layer below is held by it: 0.95 `ε_across`.
    pub across: f64,
    /// Longest planned bridge, from what holds one end to what holds the other: 0.95 `ε_along`. Runs no
    /// longer get no point.
    pub along: f64,
    /// How far from a need the path below may pass it: 0.65 `ε_across`. Larger gives the path more freedom,
    /// and more points, since a path further off holds less. Not read by the placement itself; the limits
    /// below follow from it.
    pub slack: f64,
    /// Strand no further than this from a need counts as held, whichever strand it is: `ε_across` − `slack`.
    pub cover: f64,
    /// Length of strand that a point is counted to hold either way along its own strand: needs lie up to
    /// `along` + 2 `held` apart, and up to `along` + `held` from the end of a run. The default is `cover`
    /// plus 2 % of `ε_along`, 0.137 w for clay. 0.2 w saves up to 7 % of the points, but then a path that
    /// passes two neighbours on far sides leaves a bridge up to 7 % too long, which has to be found and
    /// mended afterwards.
    pub held: f64,
    /// A point shared by two strands lies midway between them and no further than this from either: 0.57
    /// `ε_across`.
    pub share: f64,
    /// Cost of a point on a full reversal, in points. Gaps are then centred on hairpins: strand dies only at
    /// its tips, and a tip is a cantilever, not a bridge. 0 ignores them.
    pub tip_weight: f64,
    /// Arc length either way over which a reversal is judged: 0.8 w.
    pub tip_reach: f64,
    /// What it is worth that one point serves two strands, in points. Below 1, so that no point is added for
    /// its sake.
    pub share_bonus: f64,
    /// Strands are two only where the arc between them is longer than this: 2 w.
    pub apart: f64,
    /// Longest spacing of the places that are tried, 0.13 w. The number of points on a plain run does not
    /// depend on it; finer steps find tips and shared places a little better and take longer.
    pub step: f64,
}

impl Placement {
    /// The paper's clay at a bead of width `w` mm.
    #[must_use]
    pub fn for_width(w: f64) -> Self {
        Self::for_criterion(w, &Criterion::for_width(w))
    }

    /// For a bead of width `w` mm of some paste, with a slack of 0.65 `ε_across`.
    #[must_use]
    pub fn for_criterion(w: f64, criterion: &Criterion) -> Self {
        Self::with_slack(w, criterion, SLACK * criterion.across)
    }

    /// For a path below that keeps within `slack` mm of the needs, which is brought between 0 and `ε_across`.
    ///
    /// # Example
    /// ```
    /// use argil_support::{Criterion, Placement};
    /// let stiff = Criterion { across: 0.9, ..Criterion::for_width(1.5) };
    /// let usual = Placement::for_criterion(1.5, &stiff);
    /// assert_eq!(usual, Placement::with_slack(1.5, &stiff, 0.65 * stiff.across));
    /// // A path that keeps to its points needs fewer of them.
    /// let exact = Placement::with_slack(1.5, &stiff, 0.0);
    /// assert!(exact.cover > usual.cover && exact.slack == 0.0);
    /// ```
    #[must_use]
    pub fn with_slack(w: f64, criterion: &Criterion, slack: f64) -> Self {
        let slack = slack.min(criterion.across).max(0.0);
        let cover = criterion.across - slack;
        Self {
            across: MARGIN * criterion.across,
            along: MARGIN * criterion.along,
            slack,
            cover,
            held: cover + RETURNED * criterion.along,
            share: 0.57 / SLACK * slack,
            tip_weight: 1.5,
            tip_reach: 0.8 * w,
            share_bonus: 0.4,
            apart: 2.0 * w,
            step: 0.13 * w,
        }
    }

    /// Whether every number makes sense: finite, lengths not negative, bridges and steps positive.
    pub(crate) fn is_usable(&self) -> bool {
        let weights = [self.tip_weight, self.share_bonus];
        let lengths = [self.across, self.cover, self.held, self.share, self.tip_reach, self.apart];
        let positive = [self.along, self.step];
        weights.iter().all(|x| x.is_finite())
            && lengths.iter().all(|&x| x.is_finite() && x >= 0.0)
            && positive.iter().all(|&x| x.is_finite() && x > 0.0)
    }

    /// Longest distance along the strand between two needs, and from the end of a run to the nearest need.
    pub(crate) fn between(&self) -> f64 {
        self.along + 2.0 * self.held
    }

    /// Longest distance from the end of a run to the need nearest to it.
    pub(crate) fn at_end(&self) -> f64 {
        self.along + self.held
    }
}

impl Default for Placement {
    fn default() -> Self {
        Self::for_width(1.5)
    }
}
