//! Boxes, for examples and tests.

use crate::{Mesh, MeshError, Soup};

/// The corner k has the greater coordinate on the axes whose bit of k is set.
const TRIANGLES: [[u32; 3]; 12] = [
    [0, 2, 1],
    [1, 2, 3],
    [4, 5, 6],
    [5, 7, 6],
    [0, 1, 4],
    [1, 5, 4],
    [2, 6, 3],
    [3, 6, 7],
    [0, 4, 2],
    [2, 4, 6],
    [1, 3, 5],
    [3, 7, 5],
];

impl Soup {
    /// The box with axis-parallel sides between two opposite corners: eight positions and twelve triangles, outwards.
    #[must_use]
    pub fn cuboid(corner: [f64; 3], opposite: [f64; 3]) -> Self {
        let place = |k: u32| {
            [0, 1, 2].map(|axis| {
                let (a, b) = (corner[axis], opposite[axis]);
                if k >> axis & 1 == 0 { a.min(b) } else { a.max(b) }
            })
        };
        Self { vertices: (0..8).map(place).collect(), triangles: TRIANGLES.to_vec(), ..Self::default() }
    }
}

impl Mesh {
    /// The box with axis-parallel sides between two opposite corners, mm.
    ///
    /// # Errors
    /// [`MeshError::NotFinite`], and [`MeshError::NoTriangles`] for corners in one place.
    ///
    /// # Example
    /// ```
    /// use argil_mesh::Mesh;
    /// let plate = Mesh::cuboid([0.0, 0.0, 0.0], [20.0, 10.0, 2.0])?;
    /// assert_eq!((plate.vertices().len(), plate.triangles().len()), (8, 12));
    /// assert!((plate.signed_volume() - 400.0).abs() < 1e-9);
    /// # Ok::<(), argil_mesh::MeshError>(())
    /// ```
    pub fn cuboid(corner: [f64; 3], opposite: [f64; 3]) -> Result<Self, MeshError> {
        let Soup { vertices, triangles, .. } = Soup::cuboid(corner, opposite);
        Self::new(vertices, triangles)
    }
}
