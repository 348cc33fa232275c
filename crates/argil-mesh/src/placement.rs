use crate::{Bounds, MeshError};

/// How large a mesh is to be and where it is to stand.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct Placement {
    /// The size; as modelled by default.
    pub size: Size,
    /// Where in x and y; kept by default, so that a plan can be compared with its mesh.
    pub ground: Ground,
}

/// The size of a placed mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Size {
    /// As modelled, a unit of the file being a millimetre.
    #[default]
    Modelled,
    /// Scaled uniformly by this factor, about the origin of x and y where these are kept.
    Scale(f64),
    /// Scaled uniformly to this height in millimetres.
    Height(f64),
}

/// Where a placed mesh stands in x and y.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Ground {
    /// At its own coordinates (times the scale).
    #[default]
    Keep,
    /// With the middle of its bounding box at the origin.
    Centre,
    /// With the middle of its bounding box at this place in millimetres, which must be finite.
    At([f64; 2]),
}

pub(crate) fn place(
    vertices: &[[f64; 3]],
    bounds: &Bounds,
    placement: &Placement,
) -> Result<Vec<[f64; 3]>, MeshError> {
    let factor = factor(bounds.size()[2], placement.size)?;
    let (middle, place) = match placement.ground {
        Ground::Keep => ([0.0; 2], [0.0; 2]),
        Ground::Centre => ([bounds.centre()[0], bounds.centre()[1]], [0.0; 2]),
        Ground::At(place) => ([bounds.centre()[0], bounds.centre()[1]], place),
    };
    if !place.iter().all(|value| value.is_finite()) {
        return Err(MeshError::Place { x: place[0], y: place[1] });
    }
    // Move first, then scale: the lowest point then lies at zero exactly, not up to rounding.
    let (from, to) = ([middle[0], middle[1], bounds.min[2]], [place[0], place[1], 0.0]);
    let moved = |v: &[f64; 3]| [0, 1, 2].map(|axis| (v[axis] - from[axis]) * factor + to[axis]);
    let mut placed: Vec<[f64; 3]> = vertices.iter().map(moved).collect();
    if let Size::Height(height) = placement.size {
        // A layer is counted by comparing heights: the top must not miss its own by a rounding.
        for (vertex, original) in placed.iter_mut().zip(vertices) {
            // Nor may what is a rounding below the top come to lie above it.
            vertex[2] = if original[2] == bounds.max[2] { height } else { vertex[2].min(height) };
        }
    }
    Ok(placed)
}

fn factor(height: f64, size: Size) -> Result<f64, MeshError> {
    let usable = |factor: f64| factor.is_normal() && factor > 0.0;
    match size {
        Size::Modelled => Ok(1.0),
        Size::Scale(factor) if usable(factor) => Ok(factor),
        Size::Scale(factor) => Err(MeshError::Scale { factor }),
        Size::Height(to) if usable(to) && usable(to / height) => Ok(to / height),
        Size::Height(to) => Err(MeshError::Height { from: height, to }),
    }
}
