//! What can go wrong while a layer is routed.

use argil_curve::DVec2;

/// Why a layer has no cycle. Every variant says where.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RouteError {
    /// The layer has neither a wall nor a demand.
    #[error("the layer has neither a wall nor a point to support")]
    Empty,
    /// A setting is outside its range.
    #[error("the route setting `{name}` is {value}; it must be {expected}")]
    Setting {
        /// Name of the field.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What would do.
        expected: &'static str,
    },
    /// A wall has too few points or one that is not finite.
    #[error("wall {wall} is no closed curve")]
    Wall {
        /// Index of the wall in the input.
        wall: usize,
    },
    /// A wall names a parent that does not exist, or is its own ancestor.
    #[error("wall {wall} has no valid parent")]
    Parent {
        /// Index of the wall in the input.
        wall: usize,
    },
    /// The free space of a region could not be triangulated.
    #[error("the free space near ({:.3}, {:.3}) cannot be triangulated: {source}", near.x, near.y)]
    Graph {
        /// A point of the region.
        near: DVec2,
        /// What the graph says.
        #[source]
        source: argil_graph::GraphError,
    },
    /// No path leads to a point without passing a wall.
    #[error("no path leads to ({:.3}, {:.3}) without passing a wall", at.x, at.y)]
    Unreachable {
        /// The point.
        at: DVec2,
    },
    /// The assembled strand falls into several circuits.
    #[error("the strand near ({:.3}, {:.3}) hangs together with nothing else", at.x, at.y)]
    Disconnected {
        /// A point of the part that is cut off.
        at: DVec2,
    },
    /// A solver of tours gave what is no order of all stops.
    #[error("a tour through {stops} stops does not visit each of them once")]
    Tour {
        /// How many stops there are.
        stops: usize,
        /// What the solver gave.
        order: Vec<usize>,
    },
}
