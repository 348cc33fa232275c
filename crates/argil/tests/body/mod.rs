//! Bodies as lists of pieces, so that one that fails can be taken apart and written down.

mod fault;
mod lot;
mod shrink;

pub(crate) use fault::fault;
pub(crate) use lot::{KINDS, case_of};
pub(crate) use shrink::shrunk;

use argil::mesh::{Mesh, read_stl};
use argil_models::{Bounds, DVec3, Field, mesh_of};

/// Half the width of the room that bodies stand in, mm.
pub(crate) const REACH: f64 = 11.0;
/// Its height, mm.
pub(crate) const TOP: f64 = 9.0;
/// Cells of the grid that bodies are meshed on, mm: two across the thinnest features.
const CELL: f64 = 0.55;

/// A piece of a body, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Piece {
    /// From one point to another, with the radii there and round ends; a ball when they are the same.
    Rod([f64; 3], f64, [f64; 3], f64),
    /// Between two corners, with edges rounded a little.
    Block([f64; 3], [f64; 3]),
    /// About a centre, across an axis, with the radius of the ring and of its section.
    Ring([f64; 3], [f64; 3], f64, f64),
}

/// How a piece joins those before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Join {
    /// It is added.
    Add,
    /// It is added, with a fillet.
    Blend,
    /// It is taken away.
    Cut,
}

/// A body: pieces, each joined to those before.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Body(pub(crate) Vec<(Join, Piece)>);

impl Piece {
    fn field(self) -> Field {
        match self {
            Self::Rod(from, thick, to, thin) => Field::rod((from.into(), thick), (to.into(), thin)),
            Self::Block(low, high) => {
                let (low, high): (DVec3, DVec3) = (low.into(), high.into());
                Field::rounded_box(low, high, 0.2 * (high - low).min_element())
            }
            Self::Ring(centre, axis, ring, section) => {
                Field::torus(centre.into(), axis.into(), ring, section)
            }
        }
    }
}

impl Body {
    /// The body's mesh, cut off flat where it leaves the room; `None` when nothing of it is inside.
    pub(crate) fn mesh(&self) -> Option<Mesh> {
        let field = self.0.iter().fold(Field::empty(), |body, (join, piece)| match join {
            Join::Add => body.union(piece.field()),
            Join::Blend => body.blended(piece.field(), 2.0),
            Join::Cut => body.without(piece.field()),
        });
        let room = Bounds { min: DVec3::new(-REACH, -REACH, 0.0), max: DVec3::new(REACH, REACH, TOP) };
        let solid = mesh_of(&field, room, CELL).expect("the room spans a grid");
        read_stl(&solid.to_stl()).ok()
    }
}
