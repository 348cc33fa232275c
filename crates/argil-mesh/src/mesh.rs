use crate::shells::turned_outwards;
use crate::{EdgeTable, MeshError, Placement, Repairs, Soup, placement, winding};

/// Coordinates beyond this are refused: a kilometre from the origin the output grid of 1e-4 mm is still a
/// million times coarser than the numbers, and nobody prints there.
pub(crate) const LARGEST: f64 = 1e6;

/// A triangle mesh whose coincident vertices are one vertex.
///
/// Corners of a triangle run counter-clockwise seen from outside the solid. Every index is valid,
/// every coordinate finite, and no triangle names a vertex twice: the constructors see to it.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Unchecked"))]
pub struct Mesh {
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
}

/// The smallest box with axis-parallel sides that holds a mesh, in millimetres.
///
/// # Example
/// ```
/// use argil_mesh::{Bounds, Mesh};
/// let bounds: Bounds = Mesh::cuboid([0.0; 3], [4.0, 6.0, 8.0])?.bounds();
/// assert_eq!((bounds.size(), bounds.centre()), ([4.0, 6.0, 8.0], [2.0, 3.0, 4.0]));
/// # Ok::<(), argil_mesh::MeshError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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

    pub(crate) fn of<'p>(points: impl IntoIterator<Item = &'p [f64; 3]>) -> Self {
        let mut bounds = Self { min: [f64::INFINITY; 3], max: [f64::NEG_INFINITY; 3] };
        points.into_iter().for_each(|point| bounds.include(point));
        bounds
    }

    pub(crate) fn include(&mut self, point: &[f64; 3]) {
        for (axis, &value) in point.iter().enumerate() {
            self.min[axis] = self.min[axis].min(value);
            self.max[axis] = self.max[axis].max(value);
        }
    }
}

/// What a file may hold before it is known to be a mesh.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct Unchecked {
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
}

#[cfg(feature = "serde")]
impl TryFrom<Unchecked> for Mesh {
    type Error = MeshError;

    fn try_from(unchecked: Unchecked) -> Result<Self, MeshError> {
        Mesh::new(unchecked.vertices, unchecked.triangles)
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
    /// need them. Of triangles with the same corners one stays; where bodies touch in a face that both have, neither of the two
    /// does, so that the bodies are one; where both have it on the same side, each keeps its own. Vertices that no triangle uses are dropped. [`Soup::repaired`] does the same and
    /// counts what it drops.
    ///
    /// # Errors
    /// [`MeshError::NoSuchVertex`] for a wrong index, [`MeshError::NotFinite`] for a coordinate
    /// that is not finite, [`MeshError::NoTriangles`] when nothing is left, and
    /// [`MeshError::TooMany`] beyond 32-bit indices.
    ///
    /// # Complexity
    /// O(n log n) in the triangles.
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
        let soup = Soup { vertices, triangles, ..Soup::default() };
        soup.welded().map(|(mesh, _)| mesh)
    }

    /// Parts that are known to be a mesh.
    pub(crate) fn of_parts(vertices: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) -> Self {
        Self { vertices, triangles }
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

    /// The same surface with windings that agree between neighbours and shells that face outwards.
    ///
    /// Over each edge that just two triangles share, both must run opposite ways. In every
    /// connected patch the side that has more area keeps its winding and the rest is turned over. Then every shell
    /// that is inside out (it encloses a negative volume) is turned over as a whole, together with all that lies inside it,
    /// unless it lies inside another shell itself: there it is a cavity. Without that, a shell that is inside out and
    /// overlaps a sound one would cut a hole where both are.
    ///
    /// # Complexity
    /// Near linear in the number of triangles; where shells are inside out, each of them is sought in every larger one.
    ///
    /// # Example
    /// ```
    /// use argil_mesh::Mesh;
    /// let cube = Mesh::cuboid([0.0; 3], [2.0; 3])?;
    /// let turned = cube.triangles().iter().map(|&[a, b, c]| [a, c, b]).collect();
    /// let inside_out = Mesh::new(cube.vertices().to_vec(), turned)?;
    /// assert_eq!((inside_out.signed_volume(), inside_out.oriented().signed_volume()), (-8.0, 8.0));
    /// # Ok::<(), argil_mesh::MeshError>(())
    /// ```
    #[must_use]
    pub fn oriented(&self) -> Self {
        self.turned_outwards(&mut Repairs::default())
    }

    /// The mesh as [`Mesh::oriented`] has it; what was turned over, and edges that do not have two triangles, are noted.
    pub(crate) fn turned_outwards(&self, repairs: &mut Repairs) -> Self {
        let edges = self.edges();
        let middle = |corners: &[u32]| {
            let sum = |axis: usize| corners.iter().map(|&k| self.vertices[k as usize][axis]).sum::<f64>();
            [0, 1, 2].map(|axis| sum(axis) / corners.len() as f64)
        };
        for (ends, count) in edges.ends().iter().zip(edges.triangle_counts()) {
            match count {
                1 => repairs.open_edges.note(middle(ends)),
                2 => {}
                _ => repairs.crowded_edges.note(middle(ends)),
            }
        }
        let mut wound = winding::agreeing(&self.vertices, &self.triangles, &edges);
        for &triangle in &wound.turned {
            repairs.turned_triangles.note(middle(&self.triangles[triangle as usize]));
        }
        let turned = turned_outwards(&self.vertices, &mut wound, &edges);
        repairs.shells = turned.shells;
        turned.triangles.iter().for_each(|corners| repairs.turned_shells.note(middle(corners)));
        Self { vertices: self.vertices.clone(), triangles: wound.triangles }
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
