//! A closed triangle mesh.

use std::collections::BTreeMap;

use glam::DVec3;

/// A body as triangles that share vertices, counter-clockwise as seen from outside; lengths in mm, z up.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Solid {
    /// Positions, mm.
    pub vertices: Vec<[f64; 3]>,
    /// Three positions in `vertices` each.
    pub triangles: Vec<[u32; 3]>,
}

impl Solid {
    /// The mesh as a binary STL file. The same mesh gives the same bytes.
    ///
    /// Coordinates are stored in single precision, as the format has it. A triangle with a position that does not exist is
    /// left out.
    ///
    /// # Example
    /// ```
    /// let table = argil_models::table();
    /// let bytes = table.to_stl();
    /// assert_eq!(bytes.len(), 84 + 50 * table.triangles.len());
    /// ```
    #[must_use]
    pub fn to_stl(&self) -> Vec<u8> {
        let mut bytes = vec![0; 80];
        let name = b"argil model, millimetres";
        bytes[..name.len()].copy_from_slice(name);
        let corners: Vec<[DVec3; 3]> = self.corners().collect();
        bytes.extend((corners.len() as u32).to_le_bytes());
        for [a, b, c] in corners {
            let normal = (b - a).cross(c - a).normalize_or_zero();
            for value in [normal, a, b, c].into_iter().flat_map(|v| v.to_array()) {
                bytes.extend((value as f32).to_le_bytes());
            }
            bytes.extend([0, 0]);
        }
        bytes
    }

    /// Volume in mm³; positive when the triangles face outwards.
    #[must_use]
    pub fn volume(&self) -> f64 {
        self.corners().map(|[a, b, c]| a.dot(b.cross(c))).sum::<f64>() / 6.0
    }

    /// The least z of any vertex, mm; `None` without vertices.
    #[must_use]
    pub fn lowest(&self) -> Option<f64> {
        self.vertices.iter().map(|vertex| vertex[2]).reduce(f64::min)
    }

    /// Vertices minus edges plus triangles: 2 for every separate body, less 2 for every handle.
    #[must_use]
    pub fn euler_characteristic(&self) -> i64 {
        let edges = self.edges();
        self.vertices.len() as i64 - edges.len() as i64 + self.triangles.len() as i64
    }

    /// Whether every edge belongs to exactly two triangles that run along it in opposite directions, so that the mesh
    /// encloses a volume.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        self.edges().values().all(|&(up, down)| (up, down) == (1, 1))
    }

    /// For each edge, how often triangles run along it from the lower to the higher position and back.
    fn edges(&self) -> BTreeMap<(u32, u32), (usize, usize)> {
        let mut edges = BTreeMap::new();
        for &[a, b, c] in &self.triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let uses: &mut (usize, usize) = edges.entry((from.min(to), from.max(to))).or_default();
                if from < to { uses.0 += 1 } else { uses.1 += 1 }
            }
        }
        edges
    }

    fn corners(&self) -> impl Iterator<Item = [DVec3; 3]> + '_ {
        let place = |k: u32| self.vertices.get(k as usize).copied().map(DVec3::from);
        self.triangles.iter().filter_map(move |&[a, b, c]| Some([place(a)?, place(b)?, place(c)?]))
    }
}
