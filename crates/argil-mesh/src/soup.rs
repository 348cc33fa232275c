use crate::duplicates::{Distinct, distinct};
use crate::mesh::{Bounds, LARGEST};
use crate::normal::{length, normal};
use crate::weld::{Welded, compact, weld};
use crate::{Mesh, MeshError, Remark, Repairs, Unit};

/// Triangles as a file has them: nothing is welded, checked or turned yet.
///
/// Readers give this, so that a unit can be chosen and repairs can be counted before there is a [`Mesh`].
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Soup {
    /// Positions, in the file's unit.
    pub vertices: Vec<[f64; 3]>,
    /// Three positions each, counter-clockwise as seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// The unit that the file states; `None` where its format has no units.
    pub unit: Option<Unit>,
    /// What of the file was not taken as it stands.
    pub remarks: Vec<Remark>,
}

impl Soup {
    /// The box that holds the vertices which triangles name, in the file's unit; empty (its least beyond its greatest)
    /// without any. Coordinates that are not finite do not count.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        let corners = self.triangles.iter().flatten();
        let named = corners.filter_map(|&k| self.vertices.get(k as usize));
        Bounds::of(named.filter(|place| place.iter().all(|value| value.is_finite())))
    }

    /// The same triangles in millimetres, from this unit.
    ///
    /// # Example
    /// ```
    /// use argil_mesh::{Soup, Unit};
    /// let soup = Soup { vertices: vec![[1.0, 0.0, 2.0]], ..Soup::default() };
    /// assert_eq!(soup.in_millimetres(Unit::Inch).vertices, [[25.4, 0.0, 50.8]]);
    /// ```
    #[must_use]
    pub fn in_millimetres(mut self, unit: Unit) -> Self {
        if unit != Unit::Millimetre {
            let factor = unit.millimetres();
            self.vertices.iter_mut().flatten().for_each(|value| *value *= factor);
        }
        self.unit = Some(Unit::Millimetre);
        self
    }

    /// The triangles as a binary STL file: coordinates in single precision and in the soup's unit. A triangle that names a vertex which
    /// is not there is left out. The same soup gives the same bytes.
    ///
    /// # Complexity
    /// Linear in the triangles; 50 bytes each.
    ///
    /// # Example
    /// ```
    /// use argil_mesh::{Soup, stl};
    /// let soup = Soup { vertices: vec![[0.0; 3], [2.0, 0.0, 0.0], [0.0, 2.0, 1.0]], triangles: vec![[0, 1, 2]], ..Soup::default() };
    /// assert_eq!(stl(&soup.to_stl())?.vertices, soup.vertices);
    /// # Ok::<(), argil_mesh::MeshError>(())
    /// ```
    #[must_use]
    pub fn to_stl(&self) -> Vec<u8> {
        let corners = |names: &[u32; 3]| {
            let [a, b, c] = names.map(|k| self.vertices.get(k as usize).copied());
            Some([a?, b?, c?])
        };
        let mut body = Vec::with_capacity(50 * self.triangles.len());
        let mut count = 0_u32;
        for [a, b, c] in self.triangles.iter().filter_map(corners) {
            // The count of the format has 32 bits.
            let Some(next) = count.checked_add(1) else { break };
            count = next;
            let normal = normal(a, b, c);
            let length = length(normal);
            let unit = normal.map(|value| if length > 0.0 { value / length } else { 0.0 });
            for value in [unit, a, b, c].into_iter().flatten() {
                body.extend((value as f32).to_le_bytes());
            }
            body.extend([0, 0]);
        }
        let mut bytes = vec![0; 80];
        bytes.extend(count.to_le_bytes());
        bytes.append(&mut body);
        bytes
    }

    /// A triangle with three corners of its own.
    pub(crate) fn push(&mut self, corners: [[f64; 3]; 3]) -> Result<(), MeshError> {
        let count = self.vertices.len() + 3;
        let end = u32::try_from(count).map_err(|_| MeshError::TooMany { count })?;
        self.vertices.extend(corners);
        self.triangles.push([end - 3, end - 2, end - 1]);
        Ok(())
    }

    /// A mesh of the triangles as [`Mesh::new`] makes it, wound as [`Mesh::oriented`] does, and what had to be repaired for it.
    /// A unit of the soup is taken for a millimetre.
    ///
    /// # Errors
    /// Those of [`Mesh::new`].
    ///
    /// # Complexity
    /// O(n log n) in the triangles, and where shells are inside out, the triangles of each shell that may hold them.
    ///
    /// # Example
    /// ```
    /// use argil_mesh::Soup;
    /// let vertices = vec![[0.0; 3], [9.0, 0.0, 0.0], [0.0, 9.0, 0.0], [0.0, 0.0, 9.0]];
    /// // A tetrahedron that is inside out, and whose last side is there twice.
    /// let triangles = vec![[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0], [2, 3, 0]];
    /// let (mesh, repairs) = Soup { vertices, triangles, ..Soup::default() }.repaired()?;
    /// assert!(mesh.signed_volume() > 0.0);
    /// assert_eq!((repairs.turned_shells.count, repairs.duplicates.count, repairs.open_edges.count), (1, 1, 0));
    /// # Ok::<(), argil_mesh::MeshError>(())
    /// ```
    pub fn repaired(self) -> Result<(Mesh, Repairs), MeshError> {
        let (mesh, mut repairs) = self.welded()?;
        let mesh = mesh.turned_outwards(&mut repairs);
        Ok((mesh, repairs))
    }

    /// Welds, and drops what encloses nothing.
    pub(crate) fn welded(self) -> Result<(Mesh, Repairs), MeshError> {
        self.check()?;
        let Self { vertices, triangles, .. } = self;
        let mut repairs = Repairs::default();
        let Welded { vertices, triangles, moved, degenerate } = weld(vertices, triangles);
        repairs.welded = moved;
        repairs.degenerate = degenerate;
        let middle = |corners: &[u32; 3]| {
            let places = corners.map(|k| vertices[k as usize]);
            [0, 1, 2].map(|axis| places.iter().map(|place| place[axis]).sum::<f64>() / 3.0)
        };
        let Distinct { triangles, duplicates, inner } = distinct(vertices.len(), triangles);
        duplicates.iter().for_each(|corners| repairs.duplicates.note(middle(corners)));
        inner.iter().for_each(|corners| repairs.inner_faces.note(middle(corners)));
        if triangles.is_empty() {
            return Err(MeshError::NoTriangles);
        }
        // What was dropped between bodies may have been all that named a vertex.
        let (vertices, triangles) = compact(vertices, triangles);
        Ok((Mesh::of_parts(vertices, triangles), repairs))
    }

    fn check(&self) -> Result<(), MeshError> {
        if u32::try_from(self.vertices.len()).is_err() {
            return Err(MeshError::TooMany { count: self.vertices.len() });
        }
        // Half-edges are named by 32 bits as well.
        if self.triangles.len() > u32::MAX as usize / 3 {
            return Err(MeshError::TooMany { count: self.triangles.len().saturating_mul(3) });
        }
        for (index, corners) in self.triangles.iter().enumerate() {
            for &corner in corners {
                let Some(point) = self.vertices.get(corner as usize) else {
                    return Err(MeshError::NoSuchVertex { triangle: index, vertex: corner });
                };
                // The negated comparison also catches what is not a number.
                if !point.iter().all(|value| value.abs() <= LARGEST) {
                    return Err(MeshError::NotFinite { triangle: index });
                }
            }
        }
        Ok(())
    }
}
