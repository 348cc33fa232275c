use glam::DVec2;

/// The free space of one region: inside `outer` (if there is one) and outside all `holes`.
///
/// Loops are cyclic without a repeated last point, simple, and pairwise disjoint; their orientation does not
/// matter. They are the walls that no path may touch, except where it begins or ends at an attachment.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FreeSpace<'a> {
    /// The loop round the region. Without one the region is unbounded, and a frame of four far vertices is
    /// added so that it stays connected whatever the holes are.
    pub outer: Option<&'a [DVec2]>,
    /// The loops that are cut out of the region.
    pub holes: Vec<&'a [DVec2]>,
}

/// The points that become vertices of the graph.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Nodes<'a> {
    /// Wall vertices where a path may begin or end; each exactly equal to a vertex of some loop.
    pub attachments: &'a [DVec2],
    /// Points that paths are wanted between, strictly inside the free space.
    pub terminals: &'a [DVec2],
    /// Further points that give paths room to go straight. They may lie anywhere: those outside the free
    /// space, too close to a wall or too close to another vertex are dropped, earlier ones win.
    pub steiner: &'a [DVec2],
    /// Least distance in mm of a Steiner point to any other vertex, and twice its least distance to a wall.
    /// Smaller values give straighter paths and a larger graph.
    pub spacing: f64,
}
