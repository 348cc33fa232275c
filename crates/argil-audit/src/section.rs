//! Where the plane of a layer meets the edges of the mesh.
//!
//! The outline that the slicer gives has lost these points where it runs straight on. Samples of the outline begin at
//! them, so that what falls into a sharp corner is measured from the mesh as it is, by whatever program.

use argil_curve::{DVec2, SegmentIndex};
use argil_slice::mesh::Mesh;

/// In w: how near a point must lie to the outline to belong to it. The polygon kernel rounds by less.
const ON_OUTLINE: f64 = 1e-4;

/// The points in which the edges of a mesh meet rising planes, each time from the triangles that the plane meets.
pub(crate) struct Sections<'a> {
    mesh: &'a Mesh,
    /// Least and greatest height of every triangle, with its index, the lowest first.
    spans: Vec<(f64, f64, usize)>,
    next: usize,
    active: Vec<usize>,
}

impl<'a> Sections<'a> {
    pub(crate) fn new(mesh: &'a Mesh) -> Self {
        let height = |k: u32| mesh.vertices()[k as usize][2];
        let mut spans: Vec<(f64, f64, usize)> = mesh
            .triangles()
            .iter()
            .enumerate()
            .map(|(k, &[a, b, c])| {
                let [a, b, c] = [height(a), height(b), height(c)];
                (a.min(b).min(c), a.max(b).max(c), k)
            })
            .collect();
        spans.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)));
        Self { mesh, spans, next: 0, active: Vec::new() }
    }

    /// The points on a plane above all planes asked for before.
    ///
    /// # Complexity
    /// Over all planes, O(triangles log triangles + crossings of planes with triangles).
    pub(crate) fn at(&mut self, plane: f64) -> Vec<DVec2> {
        while self.spans.get(self.next).is_some_and(|span| span.0 < plane) {
            self.active.push(self.next);
            self.next += 1;
        }
        let spans = &self.spans;
        self.active.retain(|&k| spans[k].1 >= plane);
        let mut points = Vec::with_capacity(2 * self.active.len());
        for &k in &self.active {
            let corners = self.mesh.triangles()[spans[k].2].map(|k| self.mesh.vertices()[k as usize]);
            for side in 0..3 {
                let (mut low, mut high) = (corners[side], corners[(side + 1) % 3]);
                if low[2] > high[2] {
                    std::mem::swap(&mut low, &mut high);
                }
                // A vertex on the plane counts as above it, so the edge rises.
                if low[2] < plane && plane <= high[2] {
                    let t = (plane - low[2]) / (high[2] - low[2]);
                    points.push(DVec2::new(low[0], low[1]).lerp(DVec2::new(high[0], high[1]), t));
                }
            }
        }
        points
    }
}

/// The rings, each of which repeats its first point, with those of `points` put in that lie on them.
pub(crate) fn with_points(rings: &[Vec<DVec2>], points: &[DVec2], width: f64) -> Vec<Vec<DVec2>> {
    let tolerance = ON_OUTLINE * width;
    let segments =
        |ring: &[DVec2]| -> Vec<(DVec2, DVec2)> { ring.windows(2).map(|e| (e[0], e[1])).collect() };
    let sides: Vec<(DVec2, DVec2)> = rings.iter().flat_map(|ring| segments(ring)).collect();
    let index = SegmentIndex::new(
        sides.iter().map(|&(a, b)| argil_curve::Segment::new(a, b)).collect(),
        0.75 * width,
    );
    let mut put: Vec<(usize, f64, DVec2)> = points
        .iter()
        .filter_map(|&p| {
            let nearest = index.nearest_within(p, tolerance)?;
            let (a, b) = sides[nearest.index];
            let from_ends = nearest.point.distance(a).min(nearest.point.distance(b));
            (from_ends > tolerance).then(|| (nearest.index, nearest.point.distance(a), nearest.point))
        })
        .collect();
    put.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    put.dedup_by(|a, b| a.0 == b.0 && (a.1 - b.1).abs() <= tolerance);
    let mut put = put.into_iter().peekable();
    let mut side = 0;
    let mut finer = Vec::with_capacity(rings.len());
    for ring in rings {
        let mut points: Vec<DVec2> = ring.first().copied().into_iter().collect();
        for pair in ring.windows(2) {
            while let Some((_, _, p)) = put.next_if(|&(at, ..)| at == side) {
                points.push(p);
            }
            points.push(pair[1]);
            side += 1;
        }
        finer.push(points);
    }
    finer
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sides_of_a_box_are_cut_at_the_edges_of_their_triangles() {
        let mesh = Mesh::cuboid([0.0; 3], [9.0, 9.0, 3.0]).unwrap();
        let mut sections = Sections::new(&mesh);
        let square = [(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0), (0.0, 0.0)].map(DVec2::from).to_vec();
        for plane in [0.5, 1.0, 1.5, 3.0] {
            let points = sections.at(plane);
            assert_eq!(points.len(), 16, "eight triangles, two edges each");
            let ring = &with_points(std::slice::from_ref(&square), &points, 1.5)[0];
            // One more point on each side; at the very top they fall into the corners.
            assert_eq!(ring.len(), if plane < 3.0 { 9 } else { 5 }, "{ring:?}");
            assert_eq!((ring[0], ring[ring.len() - 1]), (square[0], square[0]));
            let length = |ring: &[DVec2]| ring.windows(2).map(|e| e[0].distance(e[1])).sum::<f64>();
            assert!((length(ring) - 36.0).abs() < 1e-9);
        }
        assert!(sections.at(3.5).is_empty());
    }
}
