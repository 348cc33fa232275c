//! The surface of a field, by marching tetrahedra.
//!
//! Each cube of a grid is split into six tetrahedra round its main diagonal (Kuhn's subdivision), which agree on the
//! faces that cubes share. Inside a tetrahedron the surface is a triangle or a quadrilateral between the edges on which
//! the field changes its sign; unlike marching cubes there is no ambiguous case, so the surface is closed and nowhere
//! pinched, whatever the field. Method: Doi and Koide 1991, IEICE Transactions E74 (1), 214-224.

use std::collections::HashMap;

use glam::DVec3;

use crate::{Field, Solid};

/// Nodes beyond which a grid is refused: 64 million are 512 MB of distances.
const MOST_NODES: f64 = 64e6;

/// How near a vertex may come to a grid node, as a share of the edge it lies on. Nearer ones would differ in position
/// from their neighbours by less than what readers of single precision files weld together. At a cell of 1 mm the
/// surface is moved by 0.01 mm at most.
const MARGIN: f64 = 0.01;

/// The six orders in which the main diagonal of a cube can be walked along its axes, with whether the tetrahedron of
/// the four corners met is positively oriented (even) or not.
const WALKS: [([usize; 3], bool); 6] = [
    ([0, 1, 2], true),
    ([1, 2, 0], true),
    ([2, 0, 1], true),
    ([0, 2, 1], false),
    ([2, 1, 0], false),
    ([1, 0, 2], false),
];

/// Faces of a positively oriented tetrahedron, counter-clockwise from outside.
const FACES: [[usize; 3]; 4] = [[0, 2, 1], [1, 2, 3], [0, 3, 2], [0, 1, 3]];

/// Even permutations of four corners, enough of them to bring any set of corners to the front.
const EVEN: [[usize; 4]; 12] = [
    [0, 1, 2, 3],
    [1, 2, 0, 3],
    [2, 0, 1, 3],
    [0, 2, 3, 1],
    [0, 3, 1, 2],
    [1, 0, 3, 2],
    [1, 3, 2, 0],
    [2, 1, 3, 0],
    [2, 3, 0, 1],
    [3, 0, 2, 1],
    [3, 1, 0, 2],
    [3, 2, 1, 0],
];

/// A box in space, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Bounds {
    /// The corner with the least coordinates.
    pub min: DVec3,
    /// The corner with the greatest coordinates.
    pub max: DVec3,
}

/// Why a field was not meshed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ModelError {
    /// The box is empty or not finite.
    #[error("there is no space between {min} and {max}")]
    NoSpace {
        /// Corner given as the least.
        min: DVec3,
        /// Corner given as the greatest.
        max: DVec3,
    },
    /// The cell is not a positive length, or so small that the grid would not fit into memory.
    #[error("cells of {cell} mm cannot fill the box: that takes {nodes} nodes")]
    Cell {
        /// Size of a cell, mm.
        cell: f64,
        /// Nodes that the grid would have.
        nodes: f64,
    },
}

/// The surface of the part of a field that lies within a box, as a closed mesh of outward triangles.
///
/// Grid nodes lie at `min` plus whole cells. Where the body reaches out of the box it is cut off flat, at `min` exactly:
/// a box that begins at z = 0 gives a part with a flat foot. The upper sides of the box lie on the first node at or
/// beyond `max`. Sharp edges are chamfered by up to a cell. A value that is not a number counts as outside. A field that is
/// nowhere negative gives no triangles.
///
/// # Errors
/// A box or a cell that spans no grid, or more than 64 million nodes.
///
/// # Complexity
/// O(n) evaluations of the field for n nodes.
///
/// # Example
/// ```
/// use argil_models::{Bounds, DVec3, Field, mesh_of};
/// let ball = Field::sphere(DVec3::ZERO, 5.0);
/// let box_ = Bounds { min: DVec3::new(-6.0, -6.0, 0.0), max: DVec3::splat(6.0) };
/// let dome = mesh_of(&ball, box_, 0.5)?;
/// let exact = 2.0 / 3.0 * std::f64::consts::PI * 125.0;
/// assert!((dome.volume() / exact - 1.0).abs() < 0.02);
/// assert_eq!(dome.lowest(), Some(0.0));
/// # Ok::<(), argil_models::ModelError>(())
/// ```
pub fn mesh_of(field: &Field, bounds: Bounds, cell: f64) -> Result<Solid, ModelError> {
    let grid = Grid::new(bounds, cell)?;
    let mut surface = Surface {
        values: grid.nodes().map(|node| field.distance(grid.position(node))).collect(),
        grid,
        on_edge: HashMap::new(),
        solid: Solid::default(),
    };
    let [across, deep, high] = grid.cells;
    for z in 0..high {
        for y in 0..deep {
            for x in 0..across {
                surface.cube([x, y, z]);
            }
        }
    }
    Ok(surface.solid)
}

/// A corner of cubes, counted along each axis.
type Node = [u32; 3];

/// Nodes at the corners of equal cubes.
#[derive(Clone, Copy)]
struct Grid {
    min: DVec3,
    cell: f64,
    cells: [u32; 3],
}

impl Grid {
    fn new(bounds: Bounds, cell: f64) -> Result<Self, ModelError> {
        let Bounds { min, max } = bounds;
        let size = max - min;
        if !(size.is_finite() && min.is_finite() && size.min_element() > 0.0) {
            return Err(ModelError::NoSpace { min, max });
        }
        // A hair less, so that a box of whole cells does not get one more from rounding.
        let cells = (size / cell - DVec3::splat(1e-9)).ceil().max(DVec3::ONE);
        let nodes = (cells.x + 1.0) * (cells.y + 1.0) * (cells.z + 1.0);
        if !(cell > 0.0 && cell.is_finite() && nodes <= MOST_NODES) {
            return Err(ModelError::Cell { cell, nodes });
        }
        Ok(Self { min, cell, cells: cells.to_array().map(|count| count as u32) })
    }

    fn nodes(self) -> impl Iterator<Item = Node> {
        let [x, y, z] = self.cells;
        (0..=z).flat_map(move |k| (0..=y).flat_map(move |j| (0..=x).map(move |i| [i, j, k])))
    }

    fn number(self, node: Node) -> usize {
        let [x, y, z] = node.map(|k| k as usize);
        let [across, deep, _] = self.cells.map(|k| k as usize + 1);
        (z * deep + y) * across + x
    }

    fn position(self, node: Node) -> DVec3 {
        self.min + DVec3::from(node.map(f64::from)) * self.cell
    }

    /// Whether three nodes lie on one side of the box.
    fn on_side(self, nodes: [Node; 3]) -> bool {
        (0..3).any(|axis| {
            let level = nodes[0][axis];
            (level == 0 || level == self.cells[axis]) && nodes.iter().all(|node| node[axis] == level)
        })
    }
}

/// The surface as far as it has been walked.
struct Surface {
    grid: Grid,
    values: Vec<f64>,
    /// Vertices by the two nodes of the edge that they lie on; a node's own vertex (on a side of the box) by the node
    /// twice. Looked up only, never walked through, so its order does not matter.
    on_edge: HashMap<(usize, usize), u32>,
    solid: Solid,
}

impl Surface {
    fn inside(&self, node: Node) -> bool {
        self.values[self.grid.number(node)] < 0.0
    }

    fn cube(&mut self, low: Node) {
        let corners = (0..8).map(|k| [low[0] + (k & 1), low[1] + ((k >> 1) & 1), low[2] + (k >> 2)]);
        let within = corners.filter(|&corner| self.inside(corner)).count();
        let at_side = (0..3).any(|axis| low[axis] == 0 || low[axis] + 1 == self.grid.cells[axis]);
        if within == 0 || (within == 8 && !at_side) {
            return;
        }
        for (walk, positive) in WALKS {
            let mut corners = [low; 4];
            for (k, axis) in walk.into_iter().enumerate() {
                corners[k + 1] = corners[k];
                corners[k + 1][axis] += 1;
            }
            if !positive {
                corners.swap(1, 2);
            }
            self.tetrahedron(corners);
        }
    }

    /// Corners positively oriented: seen from the first, the others turn counter-clockwise from behind.
    fn tetrahedron(&mut self, corners: [Node; 4]) {
        let inside = corners.map(|corner| self.inside(corner));
        let count = inside.iter().filter(|&&is| is).count();
        let sorted = EVEN.into_iter().find(|order| order[..count].iter().all(|&k| inside[k]));
        // Every set of corners is at the front of one of the even orders.
        let [a, b, c, d] = sorted.unwrap_or([0, 1, 2, 3]).map(|k| corners[k]);
        match count {
            1 => self.polygon(&[(a, b), (a, c), (a, d)]),
            2 => self.polygon(&[(a, c), (a, d), (b, d), (b, c)]),
            3 => self.polygon(&[(a, d), (b, d), (c, d)]),
            _ => {}
        }
        for face in FACES {
            let nodes = face.map(|k| corners[k]);
            if self.grid.on_side(nodes) {
                self.cap(nodes);
            }
        }
    }

    /// The part of a triangle on a side of the box that lies inside the body.
    fn cap(&mut self, nodes: [Node; 3]) {
        let mut edges = Vec::with_capacity(4);
        for k in 0..3 {
            let (here, next) = (nodes[k], nodes[(k + 1) % 3]);
            if self.inside(here) {
                edges.push((here, here));
            }
            if self.inside(here) != self.inside(next) {
                edges.push((here, next));
            }
        }
        if edges.len() >= 3 {
            self.polygon(&edges);
        }
    }

    /// A convex polygon of vertices given by their edges.
    fn polygon(&mut self, edges: &[(Node, Node)]) {
        let first = self.vertex(edges[0]);
        for pair in edges[1..].windows(2) {
            let triangle = [first, self.vertex(pair[0]), self.vertex(pair[1])];
            self.solid.triangles.push(triangle);
        }
    }

    fn vertex(&mut self, (from, to): (Node, Node)) -> u32 {
        let (grid, ends) = (self.grid, [self.grid.number(from), self.grid.number(to)]);
        let key = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        let vertices = &mut self.solid.vertices;
        let values = &self.values;
        *self.on_edge.entry(key).or_insert_with(|| {
            // From the lower node to the upper one, so that both ways round give the same bits.
            let (low, high) = if ends[0] <= ends[1] { (from, to) } else { (to, from) };
            let (a, b) = (values[key.0], values[key.1]);
            let t = a / (a - b);
            let t = if t.is_nan() { 0.5 } else { t.clamp(MARGIN, 1.0 - MARGIN) };
            let (low, high) = (grid.position(low), grid.position(high));
            let place = if key.0 == key.1 { low } else { low + (high - low) * t };
            vertices.push(place.to_array());
            (vertices.len() - 1) as u32
        })
    }
}
