//! The triangles of the free space, found by topology alone.

use std::collections::VecDeque;
use std::ops::Range;

use glam::DVec2;
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

use crate::GraphError;

/// A triangle of the free space, counter-clockwise.
pub(crate) struct Triangle {
    /// Indices of the corners in the list of points that was triangulated.
    pub corners: [u32; 3],
    /// Whether the edge from corner `k` to corner `k + 1` (cyclic) is a wall.
    pub is_wall: [bool; 3],
}

/// The loops, and what their vertices are in the list of points.
pub(crate) struct Loops {
    /// The vertices of each loop; they come first in the list of points, loop after loop.
    pub ranges: Vec<Range<usize>>,
    /// Whether the first loop is the outer one.
    pub has_outer: bool,
}

impl Loops {
    /// How many of the points are wall vertices.
    pub(crate) fn vertex_count(&self) -> usize {
        self.ranges.last().map_or(0, |last| last.end)
    }

    /// Every wall segment as a pair of point indices.
    pub(crate) fn segments(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        self.ranges.iter().flat_map(|range| {
            range.clone().map(|k| [k, if k + 1 == range.end { range.start } else { k + 1 }])
        })
    }
}

/// What can be wrong with the points, by their index in the list.
pub(crate) enum Conflict {
    /// The wall between the two points crosses or touches another wall.
    Walls(usize, usize),
    /// The point, which is no wall vertex, lies on a wall.
    OnWall(usize),
}

/// Triangulates distinct points with the loops as constraints and keeps the triangles of the free space.
///
/// Which side of a wall a triangle is on is read off the topology: the triangles fall into components that
/// only walls separate, each loop separates exactly two of them, and seen from the outer face the farther one
/// of the two is inside the loop. No point-in-polygon test can disagree with the triangulation then.
///
/// # Complexity
/// O(n log n) expected.
pub(crate) fn triangulate(points: &[DVec2], loops: &Loops) -> Result<Vec<Triangle>, TriangulationFailure> {
    let mut conflict = None;
    let triangulation = ConstrainedDelaunayTriangulation::<Point2<f64>>::try_bulk_load_cdt(
        points.iter().map(|p| Point2::new(p.x, p.y)).collect(),
        loops.segments().collect(),
        |[a, b]| conflict = conflict.or(Some((a, b))),
    )
    .map_err(|_| TriangulationFailure::Spade)?;
    if triangulation.num_vertices() != points.len() {
        return Err(TriangulationFailure::Spade);
    }

    let loop_of = loop_of_vertices(loops);
    // One pair of components for each loop: those on the two sides of its first wall.
    let mut sides = vec![None; loops.ranges.len()];
    let mut components = Components::new(triangulation.num_all_faces());
    for edge in triangulation.undirected_edges() {
        let half = edge.as_directed();
        let (left, right) = (half.face().fix().index(), half.rev().face().fix().index());
        if !edge.is_constraint_edge() {
            components.join(left, right);
            continue;
        }
        let (a, b) = (half.from().fix().index(), half.to().fix().index());
        match (loop_of.get(a), loop_of.get(b)) {
            (None, _) => return Err(TriangulationFailure::Conflict(Conflict::OnWall(a))),
            (_, None) => return Err(TriangulationFailure::Conflict(Conflict::OnWall(b))),
            (Some(&k), Some(&j)) if k == j && adjacent(&loops.ranges[k], a, b) => {
                sides[k] = Some((left, right));
            }
            _ => return Err(TriangulationFailure::Conflict(Conflict::Walls(a, b))),
        }
    }
    if let Some((a, b)) = conflict {
        return Err(TriangulationFailure::Conflict(Conflict::Walls(a, b)));
    }
    if triangulation.num_constraints() != loops.vertex_count() {
        // A wall that runs through a vertex of its own loop is there in pieces.
        let [a, b] = loops
            .segments()
            .find(|&[a, b]| {
                let [from, to] = [a, b].map(FixedVertexHandle::from_index);
                !triangulation.exists_constraint(from, to)
            })
            .ok_or(TriangulationFailure::Spade)?;
        return Err(TriangulationFailure::Conflict(Conflict::Walls(a, b)));
    }

    let is_free = free_components(&mut components, &sides, loops, triangulation.outer_face().fix().index());
    Ok(triangulation
        .inner_faces()
        .filter(|face| is_free[components.root(face.fix().index())])
        .map(|face| {
            let edges = face.adjacent_edges();
            Triangle {
                corners: edges.map(|edge| edge.from().fix().index() as u32),
                is_wall: edges.map(|edge| edge.is_constraint_edge()),
            }
        })
        .collect())
}

/// Why no triangulation came out.
pub(crate) enum TriangulationFailure {
    /// The caller's points or walls are in each other's way.
    Conflict(Conflict),
    /// The triangulation refused points that were checked before.
    Spade,
}

impl TriangulationFailure {
    /// The error for a caller who knows the points by another numbering: `terminal` gives the index of the
    /// terminal for a point that is no wall vertex.
    pub(crate) fn into_error(
        self,
        points: &[DVec2],
        terminal: impl Fn(usize) -> Option<usize>,
    ) -> GraphError {
        let failed = GraphError::Triangulation { points: points.len() };
        match self {
            TriangulationFailure::Conflict(Conflict::Walls(a, b)) => match (points.get(a), points.get(b)) {
                (Some(&start), Some(&end)) => GraphError::WallsMeet { start, end },
                _ => failed,
            },
            TriangulationFailure::Conflict(Conflict::OnWall(k)) => match (terminal(k), points.get(k)) {
                (Some(index), Some(&point)) => GraphError::TerminalOnWall { index, point },
                _ => failed,
            },
            TriangulationFailure::Spade => failed,
        }
    }
}

fn loop_of_vertices(loops: &Loops) -> Vec<usize> {
    loops.ranges.iter().enumerate().flat_map(|(k, range)| range.clone().map(move |_| k)).collect()
}

fn adjacent(range: &Range<usize>, a: usize, b: usize) -> bool {
    let (low, high) = (a.min(b), a.max(b));
    high - low == 1 || (low == range.start && high + 1 == range.end)
}

/// For every component root whether it is free space: inside the outer loop and inside no hole.
fn free_components(
    components: &mut Components,
    sides: &[Option<(usize, usize)>],
    loops: &Loops,
    outer_face: usize,
) -> Vec<bool> {
    let pairs: Vec<_> =
        sides.iter().map(|side| side.map(|(l, r)| (components.root(l), components.root(r)))).collect();
    let mut beside: Vec<Vec<usize>> = vec![Vec::new(); components.parents.len()];
    for (k, pair) in pairs.iter().enumerate() {
        if let Some((a, b)) = *pair {
            beside[a].push(k);
            beside[b].push(k);
        }
    }
    // Breadth first from the outside; a component is entered through the loop that contains it directly.
    #[derive(Clone, Copy)]
    struct Containment {
        in_outer: bool,
        in_hole: bool,
    }
    let mut found: Vec<Option<Containment>> = vec![None; components.parents.len()];
    let outside = components.root(outer_face);
    found[outside] = Some(Containment { in_outer: !loops.has_outer, in_hole: false });
    let mut queue = VecDeque::from([outside]);
    while let Some(here) = queue.pop_front() {
        let Some(containment) = found[here] else { continue };
        for &k in &beside[here] {
            let Some((a, b)) = pairs[k] else { continue };
            let there = if a == here { b } else { a };
            if found[there].is_none() {
                let is_outer = loops.has_outer && k == 0;
                found[there] = Some(Containment {
                    in_outer: containment.in_outer || is_outer,
                    in_hole: containment.in_hole || !is_outer,
                });
                queue.push_back(there);
            }
        }
    }
    found.iter().map(|c| c.is_some_and(|c| c.in_outer && !c.in_hole)).collect()
}

/// Disjoint sets of faces.
struct Components {
    parents: Vec<usize>,
}

impl Components {
    fn new(count: usize) -> Components {
        Components { parents: (0..count).collect() }
    }

    fn root(&mut self, mut k: usize) -> usize {
        while self.parents[k] != k {
            self.parents[k] = self.parents[self.parents[k]];
            k = self.parents[k];
        }
        k
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.parents[a.max(b)] = a.min(b);
    }
}
