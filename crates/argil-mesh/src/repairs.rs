use std::fmt;

/// How many places of one kind are remembered: enough to find the fault, few enough to read.
const MOST_PLACES: usize = 8;

/// Where something was met: how often, and the first few places.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Places {
    /// How often.
    pub count: usize,
    /// The first eight of them, in the order of the mesh; millimetres, in the coordinates of the file.
    pub first: Vec<[f64; 3]>,
}

impl Places {
    pub(crate) fn note(&mut self, place: [f64; 3]) {
        self.count += 1;
        if self.first.len() < MOST_PLACES {
            self.first.push(place);
        }
    }
}

/// What was found wrong with triangles, and what was done about it, when a mesh was made of them.
///
/// Open and crowded edges stay as they are: a gap is closed where a layer meets it, and told there.
///
/// # Example
/// ```
/// use argil_mesh::{Bounds, Mesh, Places, Repairs, Soup};
/// let mut soup = Soup::cuboid([0.0; 3], [4.0, 4.0, 4.0]);
/// soup.triangles.pop();
/// let (mesh, repairs): (Mesh, Repairs) = soup.repaired()?;
/// let (kind, places): (&str, &Places) = repairs.worst().expect("a triangle is missing");
/// assert_eq!((kind, places.count), ("open edges", 3));
/// assert_eq!(repairs.listed().iter().filter(|(_, places)| places.count > 0).count(), 1);
/// assert_eq!(mesh.bounds(), Bounds { min: [0.0; 3], max: [4.0; 3] });
/// # Ok::<(), argil_mesh::MeshError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Repairs {
    /// Connected surfaces: 1 for a plain solid, more for several bodies or for cavities.
    pub shells: usize,
    /// Vertices moved onto another one not quite in the same place, within a millionth of the mesh's size.
    pub welded: usize,
    /// Triangles with fewer than three different corners, dropped.
    pub degenerate: Places,
    /// Triangles that were there before, dropped.
    pub duplicates: Places,
    /// Faces of no thickness between two bodies, dropped, so that the bodies are one.
    pub inner_faces: Places,
    /// Triangles wound against their neighbours, turned over.
    pub turned_triangles: Places,
    /// Shells that were inside out as a whole, turned over; each with a point of it.
    pub turned_shells: Places,
    /// Edges with one triangle only: rims of holes.
    pub open_edges: Places,
    /// Edges with more than two triangles.
    pub crowded_edges: Places,
}

impl Repairs {
    /// Every kind of defect with its places, worst last; the names are in the plural.
    #[must_use]
    pub fn listed(&self) -> [(&'static str, &Places); 7] {
        [
            ("triangles without area dropped", &self.degenerate),
            ("duplicate triangles dropped", &self.duplicates),
            ("faces between bodies dropped", &self.inner_faces),
            ("triangles turned over", &self.turned_triangles),
            ("shells turned over", &self.turned_shells),
            ("edges with more than two triangles", &self.crowded_edges),
            ("open edges", &self.open_edges),
        ]
    }

    /// The worst defect, if there is any. Welding is none: formats of single precision need it.
    #[must_use]
    pub fn worst(&self) -> Option<(&'static str, &Places)> {
        self.listed().into_iter().rev().find(|(_, places)| places.count > 0)
    }
}

/// One line for each kind of defect that was met; nothing for a sound mesh.
impl fmt::Display for Repairs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let met = self.listed().into_iter().filter(|(_, places)| places.count > 0);
        for (number, (kind, places)) in met.enumerate() {
            if number > 0 {
                writeln!(f)?;
            }
            write!(f, "{} {kind}", places.count)?;
            if let Some([x, y, z]) = places.first.first() {
                write!(f, ", the first at ({x:.2}, {y:.2}, {z:.2})")?;
            }
        }
        Ok(())
    }
}
