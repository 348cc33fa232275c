//! From a region and its points to a path graph.

use glam::DVec2;

use crate::graph::PathGraph;
use crate::thinning::thin;
use crate::triangulation::{Loops, Triangle, triangulate};
use crate::{FreeSpace, GraphError, Nodes, PointKind};

/// Coordinates up to this magnitude in mm (a thousand kilometres) are accepted: far beyond it, products of
/// coordinates overflow, and long before it the output grid is finer than the number format.
const COORDINATE_LIMIT: f64 = 1e9;

/// Coordinates below this magnitude in mm are taken for zero; robust predicates on them would underflow.
const COORDINATE_FLOOR: f64 = 1e-30;

/// No node of the graph belongs to this point.
const NO_NODE: u32 = u32::MAX;

impl PathGraph {
    /// Triangulates the free space and builds the graph of paths in it.
    ///
    /// The constrained Delaunay triangulation of walls, terminals and Steiner points is cut down to the free
    /// space. Vertices of the graph are the attachments, the terminals, the kept Steiner points, and a
    /// *portal* in the middle of every triangulation edge that joins two wall vertices without being a wall.
    /// Edges join the vertices on the border of each triangle. So
    ///
    /// - no two edges cross: inside a triangle they do not, and triangles meet at their borders only;
    /// - no edge touches a wall save at an attachment;
    /// - whatever is connected in the plane is connected in the graph, through gaps however narrow. The
    ///   paper's list of vertices (Sec. 3.3) has neither portals nor connection points and falls apart there.
    ///
    /// An edge's weight is `weight(a, b)`, asked once for each edge with its ends' positions in mm. Portals
    /// are rounded to the nearest floating-point number: in a triangle thinner than that, planarity holds up
    /// to the same rounding.
    ///
    /// # Errors
    /// Coordinates that are not finite or too large, loops of fewer than three vertices, walls that meet,
    /// attachments that are no wall vertices, terminals on a wall or outside the free space, and weights that
    /// are negative or not finite; each with its place.
    ///
    /// # Complexity
    /// O(n log n) expected for n points.
    ///
    /// # Example
    /// ```
    /// use argil_graph::{FreeSpace, Nodes, PathGraph};
    /// use glam::dvec2;
    ///
    /// let room = [dvec2(0.0, 0.0), dvec2(10.0, 0.0), dvec2(10.0, 10.0), dvec2(0.0, 10.0)];
    /// let pillar = [dvec2(4.0, 2.0), dvec2(6.0, 2.0), dvec2(6.0, 10.0 - 1e-4), dvec2(4.0, 10.0 - 1e-4)];
    /// let graph = PathGraph::build(
    ///     &FreeSpace { outer: Some(&room), holes: vec![&pillar] },
    ///     &Nodes { terminals: &[dvec2(2.0, 9.0), dvec2(8.0, 9.0)], ..Nodes::default() },
    ///     |a, b| a.distance(b),
    /// )?;
    /// let (from, to) = (graph.terminal(0), graph.terminal(1));
    /// let length = graph.distances(&[from, to]).get(0, 1);
    /// // Straight through the slit of a tenth of a micrometre above the pillar, not round below it.
    /// assert!(length > 6.0 && length < 10.0);
    /// assert_eq!(graph.path(from, to).map(|path| path[0]), Some(from));
    /// # Ok::<(), argil_graph::GraphError>(())
    /// ```
    pub fn build(
        space: &FreeSpace<'_>,
        nodes: &Nodes<'_>,
        weight: impl Fn(DVec2, DVec2) -> f64 + Sync,
    ) -> Result<PathGraph, GraphError> {
        if !nodes.spacing.is_finite() || nodes.spacing < 0.0 {
            return Err(GraphError::Spacing { spacing: nodes.spacing });
        }
        let (mut points, loops) = wall_points(space)?;
        let walls = points.len();
        let (attachment_points, attachments) = locate_attachments(&points, nodes.attachments)?;
        let (terminal_points, terminals) = distinct_terminals(&points, nodes.terminals)?;
        points.extend(&terminal_points);
        let steiner = checked(nodes.steiner, PointKind::Steiner)?;
        let kept = thin(
            &steiner,
            terminal_points.iter().copied().chain(attachment_points.iter().map(|&k| points[k])),
            loops.segments().map(|[a, b]| (points[a], points[b])),
            space.outer.and_then(|_| bounds(&points[..loops.ranges[0].end])),
            nodes.spacing,
        );
        points.extend(kept);
        if !loops.has_outer {
            points.extend(frame(&points, nodes.spacing));
        }
        if points.len() > (u32::MAX / 8) as usize {
            return Err(GraphError::TooLarge { count: points.len() });
        }

        let first_steiner = walls + terminal_points.len();
        let triangles = triangulate(&points, &loops).map_err(|failure| {
            failure.into_error(&points, |k| terminals.iter().position(|&t| walls + t as usize == k))
        })?;

        let mut is_reached = vec![false; points.len()];
        for corner in triangles.iter().flat_map(|triangle| triangle.corners) {
            is_reached[corner as usize] = true;
        }
        if let Some(index) = terminals.iter().position(|&t| !is_reached[walls + t as usize]) {
            return Err(GraphError::TerminalOutside { index, point: nodes.terminals[index] });
        }

        let mut node_of = vec![NO_NODE; points.len()];
        let mut positions = Vec::new();
        let free_steiner = (first_steiner..points.len()).filter(|&k| is_reached[k]);
        for k in attachment_points.iter().copied().chain(walls..first_steiner).chain(free_steiner) {
            node_of[k] = positions.len() as u32;
            positions.push(points[k]);
        }
        let portals = portals(&triangles, walls);
        let first_portal = positions.len() as u32;
        positions.extend(portals.iter().map(|&[a, b]| 0.5 * (points[a as usize] + points[b as usize])));

        let numbering = Numbering { node_of: &node_of, walls, portals: &portals, first_portal };
        let mut pairs: Vec<(u32, u32)> = Vec::with_capacity(3 * triangles.len());
        for triangle in &triangles {
            edges_in(triangle, &numbering, |a, b| {
                if positions[a as usize] != positions[b as usize] {
                    pairs.push((a.min(b), a.max(b)));
                }
            });
        }
        pairs.sort_unstable();
        pairs.dedup();

        let attachment_count = attachment_points.len() as u32;
        let terminals = terminals.into_iter().map(|t| attachment_count + t).collect();
        PathGraph::from_pairs(positions, attachment_count, attachments, terminals, &pairs, weight)
    }
}

/// The coordinates as the triangulation takes them: finite, of moderate size, and with one zero.
fn checked(points: &[DVec2], kind: PointKind) -> Result<Vec<DVec2>, GraphError> {
    let flushed = |x: f64| if x.abs() < COORDINATE_FLOOR { 0.0 } else { x };
    let check = |(index, &point): (usize, &DVec2)| {
        let limit = COORDINATE_LIMIT;
        // Written so that NaN fails, too.
        if point.x.abs() <= limit && point.y.abs() <= limit {
            Ok(DVec2::new(flushed(point.x), flushed(point.y)))
        } else {
            Err(GraphError::Coordinate { kind, index, point, limit })
        }
    };
    points.iter().enumerate().map(check).collect()
}

fn wall_points(space: &FreeSpace<'_>) -> Result<(Vec<DVec2>, Loops), GraphError> {
    let mut points = Vec::new();
    let mut ranges = Vec::new();
    let outer = space.outer.map(|outer| (PointKind::Outer, outer));
    let holes = space.holes.iter().enumerate().map(|(k, hole)| (PointKind::Hole(k), *hole));
    for (kind, vertices) in outer.into_iter().chain(holes) {
        if vertices.len() < 3 {
            return Err(GraphError::ShortLoop { kind, vertices: vertices.len() });
        }
        let start = points.len();
        points.extend(checked(vertices, kind)?);
        ranges.push(start..points.len());
    }
    let sorted = sorted_by_place(&points);
    if let Some(pair) = sorted.windows(2).find(|pair| points[pair[0]] == points[pair[1]]) {
        return Err(GraphError::WallsMeet { start: points[pair[0]], end: points[pair[1]] });
    }
    Ok((points, Loops { ranges, has_outer: space.outer.is_some() }))
}

/// The indices of the points in the order of their coordinates, equal ones by index.
fn sorted_by_place(points: &[DVec2]) -> Vec<usize> {
    let mut sorted: Vec<usize> = (0..points.len()).collect();
    sorted.sort_unstable_by(|&a, &b| by_place(points[a], points[b]).then(a.cmp(&b)));
    sorted
}

fn by_place(a: DVec2, b: DVec2) -> std::cmp::Ordering {
    a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y))
}

/// The wall vertices that are attachments, each once, and for every attachment its place among them.
fn locate_attachments(walls: &[DVec2], attachments: &[DVec2]) -> Result<(Vec<usize>, Vec<u32>), GraphError> {
    let sorted = sorted_by_place(walls);
    let mut number = vec![NO_NODE; walls.len()];
    let mut distinct = Vec::new();
    let mut places = Vec::new();
    for (index, point) in checked(attachments, PointKind::Attachment)?.into_iter().enumerate() {
        let Ok(found) = sorted.binary_search_by(|&k| by_place(walls[k], point)) else {
            return Err(GraphError::AttachmentOffWall { index, point });
        };
        let k = sorted[found];
        if number[k] == NO_NODE {
            number[k] = distinct.len() as u32;
            distinct.push(k);
        }
        places.push(number[k]);
    }
    Ok((distinct, places))
}

/// The distinct terminals in the order of their first mention, and for every terminal its place among them.
fn distinct_terminals(walls: &[DVec2], terminals: &[DVec2]) -> Result<(Vec<DVec2>, Vec<u32>), GraphError> {
    let points = checked(terminals, PointKind::Terminal)?;
    let on_wall = sorted_by_place(walls);
    let is_wall = |p: DVec2| on_wall.binary_search_by(|&k| by_place(walls[k], p)).is_ok();
    if let Some(index) = points.iter().position(|&p| is_wall(p)) {
        return Err(GraphError::TerminalOnWall { index, point: points[index] });
    }
    // In sorted order equal terminals follow each other, the first mentioned one first.
    let mut first = vec![0; points.len()];
    let mut last: Option<usize> = None;
    for k in sorted_by_place(&points) {
        first[k] = match last {
            Some(previous) if points[previous] == points[k] => first[previous],
            _ => k,
        };
        last = Some(k);
    }
    let mut distinct = Vec::new();
    let mut places: Vec<u32> = Vec::with_capacity(points.len());
    for k in 0..points.len() {
        if first[k] == k {
            places.push(distinct.len() as u32);
            distinct.push(points[k]);
        } else {
            places.push(places[first[k]]);
        }
    }
    Ok((distinct, places))
}

fn bounds(points: &[DVec2]) -> Option<(DVec2, DVec2)> {
    Some((points.iter().copied().reduce(DVec2::min)?, points.iter().copied().reduce(DVec2::max)?))
}

/// Four corners round everything, so that an unbounded region is connected even where walls reach the convex
/// hull. They stand off by a sixteenth of the extent: paths by way of them are detours, taken only where the
/// caller's Steiner points leave no other way.
fn frame(points: &[DVec2], spacing: f64) -> Vec<DVec2> {
    let Some((low, high)) = bounds(points) else {
        return Vec::new();
    };
    let margin = (low.distance(high) / 16.0).max(spacing).max(1.0);
    let (low, high) = (low - DVec2::splat(margin), high + DVec2::splat(margin));
    vec![low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)]
}

/// The triangulation edges, as sorted pairs of points, that join wall vertices without being walls.
fn portals(triangles: &[Triangle], walls: usize) -> Vec<[u32; 2]> {
    let mut portals = Vec::new();
    for Triangle { corners: [a, b, c], is_wall } in triangles {
        for (k, (from, to)) in [(*a, *b), (*b, *c), (*c, *a)].into_iter().enumerate() {
            if !is_wall[k] && (from.max(to) as usize) < walls {
                portals.push([from.min(to), from.max(to)]);
            }
        }
    }
    portals.sort_unstable();
    portals.dedup();
    portals
}

/// Which node of the graph stands for a point or a portal.
struct Numbering<'a> {
    node_of: &'a [u32],
    walls: usize,
    portals: &'a [[u32; 2]],
    first_portal: u32,
}

impl Numbering<'_> {
    fn is_wall_vertex(&self, point: u32) -> bool {
        (point as usize) < self.walls
    }

    /// The node of a terminal, Steiner point or attachment; none for other wall vertices.
    fn node(&self, point: u32) -> Option<u32> {
        let node = self.node_of[point as usize];
        (node != NO_NODE).then_some(node)
    }

    fn portal(&self, a: u32, b: u32) -> Option<u32> {
        self.portals.binary_search(&[a.min(b), a.max(b)]).ok().map(|k| self.first_portal + k as u32)
    }
}

/// The graph's edges within one triangle.
///
/// Portals and free corners are joined with each other. An attachment is joined with the free corners and
/// with the portals on its own two edges, not with the opposite one: that edge would cross the one between
/// the other two portals. Only in an ear, a triangle with walls on both sides of the attachment, the opposite
/// portal is its only way out, and there nothing can be crossed.
fn edges_in(triangle: &Triangle, numbering: &Numbering<'_>, mut edge: impl FnMut(u32, u32)) {
    let [a, b, c] = triangle.corners;
    let portal = |k: usize, from: u32, to: u32| {
        if triangle.is_wall[k] || !(numbering.is_wall_vertex(from) && numbering.is_wall_vertex(to)) {
            None
        } else {
            numbering.portal(from, to)
        }
    };
    // The portal on the edge after each corner.
    let portals = [portal(0, a, b), portal(1, b, c), portal(2, c, a)];
    let nodes = triangle.corners.map(|corner| numbering.node(corner));
    let is_wall_vertex = triangle.corners.map(|corner| numbering.is_wall_vertex(corner));
    let free = |k: usize| nodes[k].filter(|_| !is_wall_vertex[k]);
    let inner = [free(0), portals[0], free(1), portals[1], free(2), portals[2]];
    for (k, a) in inner.iter().enumerate() {
        let Some(a) = *a else { continue };
        inner[k + 1..].iter().flatten().for_each(|&b| edge(a, b));
    }
    for k in 0..3 {
        let Some(attachment) = nodes[k].filter(|_| is_wall_vertex[k]) else { continue };
        let (before, opposite) = ((k + 2) % 3, (k + 1) % 3);
        let is_ear = triangle.is_wall[before] && triangle.is_wall[k];
        let ways = [free(opposite), free(before), portals[before], portals[k]];
        ways.into_iter().flatten().for_each(|way| edge(attachment, way));
        if let Some(way) = portals[opposite].filter(|_| is_ear) {
            edge(attachment, way);
        }
    }
}
