//! The closed cycle of a layer.

use argil_curve::DVec2;

/// What a stretch of the cycle is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Leg {
    /// It prints a wall.
    Wall,
    /// It belongs to an excursion that serves at least one demand.
    Support,
    /// It only joins walls.
    Joint,
}

/// One closed cycle through all walls and demands of a layer.
///
/// The vectors `points`, `fixed` and `legs` have one entry a vertex; vertex k + 1 follows vertex k and
/// vertex 0 follows the last.
///
/// Invariants: every wall is printed exactly once, whole, and its vertices are bit-identical to the
/// input's; no two stretches cross, neither properly nor at a shared vertex; each demand is carried by a vertex.
///
/// # Example
/// ```
/// use argil_route::{Cycle, DVec2, LayerInput, Leg, RouteSettings, Router, Wall};
/// let square = [(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)].map(DVec2::from);
/// let walls = [Wall { points: &square, parent: None }];
/// let layer = LayerInput { walls: &walls, demands: &[], safeguard: &[], above: None, barred: &[] };
/// // A layer that is one wall and nothing else is that wall.
/// let cycle: Cycle = Router::new(RouteSettings::for_width(1.5))?.cycle(&layer)?;
/// assert_eq!((cycle.length_of(Leg::Wall), cycle.length_of(Leg::Support), cycle.roots), (36.0, 0.0, 0));
/// # Ok::<(), argil_route::RouteError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Cycle {
    /// The vertices, mm.
    pub points: Vec<DVec2>,
    /// Whether a vertex belongs to a wall and must stay.
    pub fixed: Vec<bool>,
    /// What the stretch from vertex k to vertex k + 1 is for.
    pub legs: Vec<Leg>,
    /// Which vertex carries which demand: pairs (vertex, index of the demand).
    pub carriers: Vec<(usize, usize)>,
    /// How often the strand leaves a wall: places where two legs meet it.
    pub roots: usize,
}

impl Cycle {
    /// The cycle of a layer that is one wall and nothing else.
    pub(crate) fn of_wall(points: &[DVec2]) -> Self {
        Self {
            points: points.to_vec(),
            fixed: vec![true; points.len()],
            legs: vec![Leg::Wall; points.len()],
            carriers: Vec::new(),
            roots: 0,
        }
    }

    /// Length of all stretches with the given purpose, mm.
    #[must_use]
    pub fn length_of(&self, leg: Leg) -> f64 {
        let ends = self.points.iter().zip(self.points.iter().cycle().skip(1));
        let of_leg = ends.zip(&self.legs).filter(|(_, of)| **of == leg);
        // The standard library's sum of nothing is −0.
        of_leg.fold(0.0, |sum, ((from, to), _)| sum + from.distance(*to))
    }
}
