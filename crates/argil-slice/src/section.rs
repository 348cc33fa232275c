use argil_mesh::{EdgeTable, Mesh};
use glam::DVec2;

/// The directed piece of a cut that one triangle contributes, with the solid on its left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cut {
    /// Mesh edge on which the piece begins.
    pub(crate) start: u32,
    /// Mesh edge on which it ends.
    pub(crate) end: u32,
    pub(crate) from: DVec2,
    pub(crate) to: DVec2,
}

/// Cuts a mesh at rising heights, each time touching only the triangles that the plane meets.
///
/// A vertex at the height of the plane counts as above it. So a plane never meets a vertex, every
/// triangle that it meets it meets in two edges, and flat faces in the plane need no special case:
/// both triangles of an edge agree on whether it is met and, since the point is computed from the edge
/// alone, on where.
pub(crate) struct Sweep<'a> {
    mesh: &'a Mesh,
    edges: &'a EdgeTable,
    /// Triangles by the first plane that meets them.
    order: Vec<u32>,
    begins: Vec<usize>,
    /// The last plane that meets each triangle.
    last: Vec<u32>,
    active: Vec<u32>,
    planes: &'a [f64],
    next: usize,
}

impl<'a> Sweep<'a> {
    /// The planes must rise.
    pub(crate) fn new(mesh: &'a Mesh, edges: &'a EdgeTable, planes: &'a [f64]) -> Self {
        let spans: Vec<(usize, usize)> = mesh
            .triangles()
            .iter()
            .map(|corners| {
                let heights = corners.map(|k| mesh.vertices()[k as usize][2]);
                let low = heights.iter().copied().fold(f64::INFINITY, f64::min);
                let high = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                // met by plane z when low < z <= high
                (planes.partition_point(|&z| z <= low), planes.partition_point(|&z| z <= high))
            })
            .collect();
        let mut begins = vec![0; planes.len() + 1];
        for &(first, end) in &spans {
            if first < end {
                begins[first + 1] += 1;
            }
        }
        for k in 1..begins.len() {
            begins[k] += begins[k - 1];
        }
        let mut order = vec![0; begins[planes.len()]];
        let mut filled = begins.clone();
        for (triangle, &(first, end)) in spans.iter().enumerate() {
            if first < end {
                order[filled[first]] = triangle as u32;
                filled[first] += 1;
            }
        }
        let last = spans.iter().map(|&(_, end)| end.saturating_sub(1) as u32).collect();
        Self { mesh, edges, order, begins, last, active: Vec::new(), planes, next: 0 }
    }

    /// The pieces of the next cut, in an order that depends on the mesh alone; none after the last plane.
    pub(crate) fn advance(&mut self, cuts: &mut Vec<Cut>) {
        cuts.clear();
        let layer = self.next;
        let Some(&plane) = self.planes.get(layer) else { return };
        self.next += 1;
        let last = &self.last;
        self.active.retain(|&triangle| last[triangle as usize] as usize >= layer);
        self.active.extend(&self.order[self.begins[layer]..self.begins[layer + 1]]);
        cuts.extend(self.active.iter().map(|&triangle| self.cut(triangle as usize, plane)));
    }

    fn cut(&self, triangle: usize, plane: f64) -> Cut {
        let corners = self.mesh.triangles()[triangle];
        let sides = self.edges.of_triangles()[triangle];
        let above = corners.map(|k| self.mesh.vertices()[k as usize][2] >= plane);
        // Seen from outside the corners run counter-clockwise; the solid is on the left of the piece
        // that goes from where the boundary comes down through the plane to where it goes up.
        let (mut down, mut up) = (sides[0], sides[0]);
        for side in 0..3 {
            match (above[side], above[(side + 1) % 3]) {
                (true, false) => down = sides[side],
                (false, true) => up = sides[side],
                _ => {}
            }
        }
        Cut { start: down, end: up, from: self.crossing(down, plane), to: self.crossing(up, plane) }
    }

    /// Where an edge meets the plane: the same bits for both its triangles.
    fn crossing(&self, edge: u32, plane: f64) -> DVec2 {
        let [mut low, mut high] = self.edges.ends()[edge as usize].map(|k| self.mesh.vertices()[k as usize]);
        if low[2] > high[2] {
            std::mem::swap(&mut low, &mut high);
        }
        let rise = high[2] - low[2];
        // An edge that a plane meets has its ends on different sides, so it rises.
        let t = if rise > 0.0 { (plane - low[2]) / rise } else { 0.0 };
        DVec2::new(low[0], low[1]).lerp(DVec2::new(high[0], high[1]), t)
    }
}
