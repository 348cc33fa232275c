//! Rings into as few closed curves as short joints allow.

use argil_curve::DVec2;

use crate::joint::Joint;
use crate::ring::{Ring, Track};
use crate::trace::traced;
use crate::tree::{Fence, Tier, Tree};
use crate::{FillCurve, FillError, FillOptions};

/// Curves and the joints that made them.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Merged {
    /// The curves, each with one role a segment.
    pub curves: Vec<FillCurve>,
    /// The joints, in the order in which they were made: the best first.
    pub joints: Vec<Joint>,
}

/// Merges rings into as few closed curves as joints of at most [`FillOptions::reach`] allow.
///
/// Candidates for joints are scored by how straight and parallel they lie, and taken in the order of their score
/// as long as they join what is not joined yet (Kruskal): a spanning tree of the rings. A joint between rings of a fill is an H,
/// two parallel legs one bead apart, so that the strand is as long as before and lies one bead from itself. At a wall
/// it is a V with its point on the wall, between two walls a slit, so that the walls stay whole but for
/// [`FillOptions::wall_cut`]. Joints keep away from the places in `avoid`, such as the joints of the layer below, where they can.
///
/// Vertices of the rings stay as they are, bit by bit, except for those that are cut out.
///
/// # Errors
/// [`FillError::Option`] and [`FillError::Ring`].
///
/// # Complexity
/// O(places tried · log n) for n segments; at most 32 places for a pair of neighbours, all places every
/// fifth of a bead for those that are left.
///
/// # Example
/// ```
/// use argil_fill::{DVec2, FillOptions, Merged, Ring, merge};
/// let square = |half: f64| [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|c| half * DVec2::from(c)).to_vec();
/// let walls = [Ring { points: square(9.25), wall: Some(0) }, Ring { points: square(7.75), wall: Some(1) }];
/// let merged: Merged = merge(&walls, &FillOptions::for_width(1.5), &[])?;
/// assert_eq!((merged.curves.len(), merged.joints.len()), (1, 1));
/// # Ok::<(), argil_fill::FillError>(())
/// ```
pub fn merge(rings: &[Ring], options: &FillOptions, avoid: &[DVec2]) -> Result<Merged, FillError> {
    merge_within(rings, options, avoid, None)
}

/// Merges rings as [`merge`] does, with joints inside of a fence between those that have one.
pub(crate) fn merge_within(
    rings: &[Ring],
    options: &FillOptions,
    avoid: &[DVec2],
    fence: Option<&Fence>,
) -> Result<Merged, FillError> {
    options.check()?;
    let tracks = rings
        .iter()
        .enumerate()
        .map(|(number, ring)| Track::new(number, ring, options.width))
        .collect::<Result<Vec<_>, _>>()?;
    let mut tree = Tree::new(&tracks, options, fence);
    for tier in TIERS {
        tree.grow(tier, avoid);
    }
    let curves = traced(&tracks, tree.joints(), options.grid);
    let joints = tree
        .joints()
        .iter()
        .map(|c| Joint { rings: c.tracks, legs: c.legs.map(|leg| [leg.start, leg.end]) })
        .collect();
    Ok(Merged { curves, joints })
}

/// First few places at neighbours, which do for nearly all rings; then all, and narrower joints for tiny rings and crowded places.
const TIERS: [Tier; 5] = [
    Tier { cut: 1.0, margin: 0.5, apart: 0.2, reach: 1.4, step: 0.4, samples: 32 },
    Tier { cut: 1.0, margin: 0.5, apart: 0.2, reach: 10.0, step: 0.2, samples: 100_000 },
    Tier { cut: 0.7, margin: 0.3, apart: 0.05, reach: 10.0, step: 0.2, samples: 100_000 },
    Tier { cut: 0.45, margin: 0.1, apart: 0.05, reach: 10.0, step: 0.2, samples: 100_000 },
    Tier { cut: 0.25, margin: 0.05, apart: 0.03, reach: 10.0, step: 0.2, samples: 100_000 },
];
