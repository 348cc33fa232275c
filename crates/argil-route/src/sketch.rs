//! Which tours a region is to have, before they are drawn on its graph.

/// A stop of a sketched tour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stop {
    Demand(usize),
    Place(usize),
}

/// Which tours a region is to have, before they are drawn.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sketch {
    /// Places on walls: (index among the region's walls, arc).
    pub(crate) places: Vec<(usize, f64)>,
    pub(crate) tours: Vec<Vec<Stop>>,
    /// Whether the first tour goes through all walls.
    pub(crate) round: bool,
    /// Whether the stops of each tour are in an order to begin the search from.
    pub(crate) ordered: bool,
    /// Whether the demands were moved towards the tours already.
    pub(crate) moved: bool,
}
