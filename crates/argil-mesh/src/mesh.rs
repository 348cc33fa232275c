use crate::weld::{Welded, weld};
use crate::{EdgeTable, MeshError, Placement, placement, winding};

/// Coordinates beyond this are refused: their squares and cubes (areas, volumes) must stay exact
/// enough to compare, and nobody prints a thousand kilometres.
pub(crate) const LARGEST: f64 = 1e9;

/// A triangle mesh whose coincident vertices are one vertex.
///
/// Corners of a triangle run counter-clockwise seen from outside the solid. Every index is valid,
/// every coordinate finite, and no triangle names a vertex twice: the constructors see to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
}

/// The smallest box with axis-parallel sides that holds a mesh, in millimetres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The least x, y and z.
    pub min: [f64; 3],
    /// The greatest x, y and z.
    pub max: [f64; 3],
}

impl Bounds {
    /// The extents in x, y and z.
    #[must_use]
    pub fn size(&self) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.max[axis] - self.min[axis])
    }

    /// The middle of the box.
    #[must_use]
    pub fn centre(&self) -> [f64; 3] {
        [0, 1, 2].map(|axis| 0.5 * (self.min[axis] + self.max[axis]))
    }

    pub(crate) fn of(points: &[[f64; 3]]) -> Self {
        let mut bounds = Self { min: [f64::INFINITY; 3], max: [f64::NEG_INFINITY; 3] };
        for point in points {
            for (axis, &value) in point.iter().enumerate() {
                bounds.min[axis] = bounds.min[axis].min(value);
                bounds.max[axis] = bounds.max[axis].max(value);
            }
        }
        bounds
    }
}

impl Mesh {
    /// A mesh of these triangles, with vertices welded that lie within a millionth of its size of
    /// each other.
    ///
    /// Exporters write every triangle with its own three corners, some after a rounding of their
    /// own; sections can be chained only where neighbours share vertices. Triangles with fewer
    /// than three different corners are dropped: they enclose nothing and their neighbours meet
    /// without them. Thin triangles of no area but three corners stay, since their neighbours
    /// need them. Vertices that no triangle uses are dropped.
    ///
    /// # Errors
    /// [`MeshError::NoSuchVertex`] for a wrong index, [`MeshError::NotFinite`] for a coordinate
    /// that is not finite, [`MeshError::NoTriangles`] when nothing is left, and
    /// [`MeshError::TooMany`] beyond 32-bit indices.
    ///
    /// # Complexity
    /// Linear in the number of triangles.
    ///
    /// # Example
    /// ```
    /// use argil_mesh::Mesh;
    /// let corners = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1e-9, 0.0], [1.0, 1.0, 0.0]];
    /// let mesh = Mesh::new(corners, vec![[0, 1, 2], [2, 3, 4], [1, 3, 0]])?;
    /// assert_eq!(mesh.vertices().len(), 4); // 1 and 3 are one vertex
    /// assert_eq!(mesh.triangles().len(), 2); // and so the third triangle is an edge
    /// # Ok::<(), argil_mesh::MeshError>(())
    /// ```
    pub fn new(vertices: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        if u32::try_from(vertices.len()).is_err() {
            return Err(MeshError::TooMany { count: vertices.len() });
        }
        for (index, corners) in triangles.iter().enumerate() {
            for &corner in corners {
                let Some(point) = vertices.get(corner as usize) else {
                    return Err(MeshError::NoSuchVertex { triangle: index, vertex: corner });
                };
                // The negated comparison also catches what is not a number.
                if !point.iter().all(|value| value.abs() <= LARGEST) {
                    return Err(MeshError::NotFinite { triangle: index });
                }
            }
        }
        let Welded { vertices, triangles } = weld(vertices, triangles);
        if triangles.is_empty() {
            return Err(MeshError::NoTriangles);
        }
        Ok(Self { vertices, triangles })
    }

    /// The corners, each once, in millimetres.
    #[must_use]
    pub fn vertices(&self) -> &[[f64; 3]] {
        &self.vertices
    }

    /// The triangles as indices into [`Mesh::vertices`].
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The box that holds the mesh.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        Bounds::of(&self.vertices)
    }

    /// The enclosed volume in cubic millimetres: negative when the mesh is inside out.
    ///
    /// It is the sum of the signed tetrahedra between each triangle and one point, which for a closed
    /// mesh does not depend on the point; the middle of the box keeps rounding small. For an
    /// open mesh it is only a hint.
    #[must_use]
    pub fn signed_volume(&self) -> f64 {
        let middle = self.bounds().centre();
        let sum: f64 = self
            .triangles
            .iter()
            .map(|&corners| {
                let [a, b, c] = corners.map(|k| {
                    let point = self.vertices[k as usize];
                    [0, 1, 2].map(|axis| point[axis] - middle[axis])
                });
                a[0] * (b[1] * c[2] - b[2] * c[1])
                    + a[1] * (b[2] * c[0] - b[0] * c[2])
                    + a[2] * (b[0] * c[1] - b[1] * c[0])
            })
            .sum();
        sum / 6.0
    }

    /// The undirected edges, and which three bound each triangle.
    ///
    /// # Complexity
    /// Near linear in the number of triangles; nothing is cached.
    #[must_use]
    pub fn edges(&self) -> EdgeTable {
        EdgeTable::new(self.vertices.len(), &self.triangles)
    }

    /// The same surface with windings that agree between neighbours.
    ///
    /// Over each edge that just two triangles share, both must run opposite ways. In every
    /// connected patch the side that has more area keeps its winding and the rest is turned over.
    /// A patch as a whole is never turned over: a cavity is wound the other way on purpose, and a
    /// non-zero winding rule takes a model that is wholly inside out for what it is.
    ///
    /// # Complexity
    /// Near linear in the number of triangles.
    #[must_use]
    pub fn oriented(&self) -> Self {
        Self {
            vertices: self.vertices.clone(),
            triangles: winding::agreeing(&self.vertices, &self.triangles, &self.edges()),
        }
    }

    /// The mesh scaled along each axis by a factor of its own, about the origin: what makes up for clay that shrinks more in height
    /// than in width.
    ///
    /// # Errors
    /// [`MeshError::Scale`] where a factor is not positive and finite, [`MeshError::NotFinite`] where a coordinate gets too large.
    ///
    /// # Complexity
    /// O(vertices + triangles).
    ///
    /// # Example
    /// ```
    /// # use argil_mesh::Mesh;
    /// let mesh = Mesh::new(vec![[0.0; 3], [2.0, 0.0, 0.0], [2.0, 2.0, 2.0]], vec![[0, 1, 2]])?;
    /// assert_eq!(mesh.stretched([1.0, 1.5, 2.0])?.vertices()[2], [2.0, 3.0, 4.0]);
    /// # Ok::<(), argil_mesh::MeshError>(())
    /// ```
    pub fn stretched(&self, factors: [f64; 3]) -> Result<Self, MeshError> {
        if let Some(&factor) = factors.iter().find(|factor| !(factor.is_normal() && **factor > 0.0)) {
            return Err(MeshError::Scale { factor });
        }
        let stretch = |vertex: &[f64; 3]| std::array::from_fn(|axis| vertex[axis] * factors[axis]);
        self.with_vertices(self.vertices.iter().map(stretch).collect())
    }

    /// The mesh scaled and moved onto the bed: its lowest point comes to lie at z = 0.
    ///
    /// # Errors
    /// [`MeshError::Scale`] and [`MeshError::Height`] for sizes that are not positive and finite, or that a
    /// flat mesh cannot be brought to; [`MeshError::NotFinite`] when the result is too large for
    /// lengths.
    ///
    /// # Example
    /// ```
    /// use argil_mesh::{Ground, Mesh, Placement, Size};
    /// let mesh = Mesh::new(vec![[2.0, 0.0, 7.0], [4.0, 0.0, 7.0], [2.0, 2.0, 9.0]], vec![[0, 1, 2]])?;
    /// let kept = mesh.placed(&Placement::default())?;
    /// assert_eq!(kept.vertices()[2], [2.0, 2.0, 2.0]);
    /// let placed = mesh.placed(&Placement { size: Size::Scale(3.0), ground: Ground::Centre })?;
    /// assert_eq!(placed.bounds().min, [-3.0, -3.0, 0.0]);
    /// # Ok::<(), argil_mesh::MeshError>(())
    /// ```
    pub fn placed(&self, placement: &Placement) -> Result<Self, MeshError> {
        let vertices = placement::place(&self.vertices, &self.bounds(), placement)?;
        self.with_vertices(vertices)
    }

    /// The same triangles between vertices that have moved.
    fn with_vertices(&self, vertices: Vec<[f64; 3]>) -> Result<Self, MeshError> {
        if let Some(triangle) = self.triangles.iter().position(|corners| {
            corners.iter().any(|&k| !vertices[k as usize].iter().all(|value| value.abs() <= LARGEST))
        }) {
            return Err(MeshError::NotFinite { triangle });
        }
        Ok(Self { vertices, triangles: self.triangles.clone() })
    }
}
