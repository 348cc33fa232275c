use glam::DVec2;

/// Which of the caller's lists a point came from.
///
/// # Example
/// ```
/// use argil_graph::{DVec2, FreeSpace, GraphError, Nodes, PathGraph, PointKind};
/// let square = [(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)].map(DVec2::from);
/// let space = FreeSpace { outer: Some(&square), holes: vec![&square[..2]] };
/// let nodes = Nodes { attachments: &[], terminals: &[], steiner: &[], spacing: 1.0 };
/// let refused = PathGraph::build(&space, &nodes, |a, b| a.distance(b)).unwrap_err();
/// assert_eq!(refused, GraphError::ShortLoop { kind: PointKind::Hole(0), vertices: 2 });
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PointKind {
    /// A vertex of the outer loop; the index counts along the loop.
    Outer,
    /// A vertex of the hole with this index; the point's index counts along the loop.
    Hole(usize),
    /// A terminal.
    Terminal,
    /// An attachment.
    Attachment,
    /// A Steiner point.
    Steiner,
    /// A vertex of an explicitly given graph.
    Vertex,
}

/// Why a path graph could not be built; every variant says where.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GraphError {
    /// A coordinate is not finite, or so large that products of coordinates lose all meaning.
    #[error("point {index} of {kind:?} is not a finite point within {limit} mm of the origin: {point}")]
    Coordinate {
        /// The list that the point came from.
        kind: PointKind,
        /// The point's index in that list.
        index: usize,
        /// The point itself.
        point: DVec2,
        /// The largest magnitude of a coordinate that is accepted, in mm.
        limit: f64,
    },
    /// The spacing of the Steiner points is negative or not finite.
    #[error("the spacing {spacing} mm is not a finite length")]
    Spacing {
        /// The spacing as given, in mm.
        spacing: f64,
    },
    /// A loop has fewer than three vertices and so encloses nothing.
    #[error("{kind:?} has {vertices} vertices, a loop needs three")]
    ShortLoop {
        /// The outer loop or one of the holes.
        kind: PointKind,
        /// How many vertices it has.
        vertices: usize,
    },
    /// Two walls cross, touch, or run along each other, or one loop does so with itself.
    #[error("the wall from {start} to {end} crosses or touches another wall")]
    WallsMeet {
        /// Where the wall segment (or the part of it that is met) begins.
        start: DVec2,
        /// Where it ends.
        end: DVec2,
    },
    /// An attachment is not exactly a vertex of any loop.
    #[error("attachment {index} at {point} is no vertex of a wall")]
    AttachmentOffWall {
        /// The attachment's index.
        index: usize,
        /// Where it is.
        point: DVec2,
    },
    /// A terminal lies exactly on a wall.
    #[error("terminal {index} at {point} lies on a wall")]
    TerminalOnWall {
        /// The terminal's index.
        index: usize,
        /// Where it is.
        point: DVec2,
    },
    /// A terminal lies outside the region, or inside a hole.
    #[error("terminal {index} at {point} lies outside the free space")]
    TerminalOutside {
        /// The terminal's index.
        index: usize,
        /// Where it is.
        point: DVec2,
    },
    /// The weight of an edge is negative or not finite.
    #[error("the edge from {from} to {to} has the weight {weight}")]
    Weight {
        /// One end of the edge.
        from: DVec2,
        /// Its other end.
        to: DVec2,
        /// The weight that was given.
        weight: f64,
    },
    /// An explicitly given edge, attachment or terminal names a vertex that does not exist.
    #[error("vertex {vertex} does not exist, there are {count}")]
    NoSuchVertex {
        /// The vertex that was named.
        vertex: u32,
        /// How many vertices there are.
        count: usize,
    },
    /// An explicitly given edge joins a vertex to itself.
    #[error("an edge joins vertex {vertex} to itself")]
    LoopEdge {
        /// The vertex.
        vertex: u32,
    },
    /// There are more vertices or edges than 32-bit indices can name.
    #[error("{count} vertices or edges are more than 32-bit indices can name")]
    TooLarge {
        /// How many there are.
        count: usize,
    },
    /// The triangulation did not take the points as they are; a defence, no input is known to cause it.
    #[error("the triangulation of {points} points failed")]
    Triangulation {
        /// How many points there were.
        points: usize,
    },
}
