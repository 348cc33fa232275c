//! The chordal axis of a polygon: a discrete stand-in for its medial axis, after Prasad (1997), "Morphological
//! analysis of shapes", CNLS Newsletter 139.
//!
//! The polygon is triangulated without further vertices; the axis joins the middles of the chords, the edges that
//! are no sides. It cannot leave the polygon, and it branches where the polygon does. In a strip it is
//! the middle line; where the boundary is a circle it is any of many curves near the middle.

use glam::DVec2;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

/// The middle of a chord, or of a triangle whose three sides are chords.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AxisNode {
    pub(crate) at: DVec2,
    /// The ends of the chord, as indices of boundary points.
    pub(crate) chord: Option<[usize; 2]>,
}

/// The axis as a graph.
#[derive(Clone, Debug, Default)]
pub(crate) struct ChordalAxis {
    pub(crate) nodes: Vec<AxisNode>,
    /// The neighbours of each node.
    pub(crate) links: Vec<Vec<usize>>,
}

impl ChordalAxis {
    /// The axis of the region between closed rings; `None` where rings meet themselves or each other.
    /// Boundary points are numbered ring after ring.
    ///
    /// # Complexity
    /// O(n log n) expected.
    pub(crate) fn of(rings: &[Vec<DVec2>]) -> Option<Self> {
        let points: Vec<Point2<f64>> = rings.iter().flatten().map(|p| Point2::new(p.x, p.y)).collect();
        let mut sides = Vec::with_capacity(points.len());
        let mut first = 0;
        for ring in rings {
            let count = ring.len();
            sides.extend((0..count).map(|k| [first + k, first + (k + 1) % count]));
            first += count;
        }
        let (count, mut conflicts) = (points.len(), 0);
        let triangulation =
            ConstrainedDelaunayTriangulation::<Point2<f64>>::try_bulk_load_cdt(points, sides, |_| {
                conflicts += 1;
            })
            .ok()?;
        let is_whole = conflicts == 0
            && triangulation.num_vertices() == count
            && triangulation.num_constraints() == count;
        is_whole.then(|| Self::through(&triangulation))
    }

    fn through(triangulation: &ConstrainedDelaunayTriangulation<Point2<f64>>) -> Self {
        let inside = inside(triangulation);
        let mut axis = Self::default();
        let mut node_of_edge: Vec<Option<usize>> = vec![None; triangulation.num_undirected_edges()];
        for face in triangulation.inner_faces().filter(|face| inside[face.fix().index()]) {
            let mut chords = [0; 3];
            let mut count = 0;
            for edge in face.adjacent_edges() {
                if edge.is_constraint_edge() {
                    continue;
                }
                let slot = &mut node_of_edge[edge.as_undirected().fix().index()];
                let node = *slot.get_or_insert_with(|| {
                    let [from, to] = [edge.from(), edge.to()];
                    let [a, b] = [from, to].map(|end| DVec2::new(end.position().x, end.position().y));
                    let chord = [from.fix().index(), to.fix().index()];
                    axis.add(AxisNode { at: a.midpoint(b), chord: Some(chord) })
                });
                chords[count] = node;
                count += 1;
            }
            match chords[..count] {
                [a, b] => axis.link(a, b),
                [a, b, c] => {
                    let at = (axis.nodes[a].at + axis.nodes[b].at + axis.nodes[c].at) / 3.0;
                    let middle = axis.add(AxisNode { at, chord: None });
                    [a, b, c].into_iter().for_each(|node| axis.link(middle, node));
                }
                _ => {}
            }
        }
        axis
    }

    fn add(&mut self, node: AxisNode) -> usize {
        self.nodes.push(node);
        self.links.push(Vec::new());
        self.nodes.len() - 1
    }

    fn link(&mut self, a: usize, b: usize) {
        self.links[a].push(b);
        self.links[b].push(a);
    }
}

/// For each face, whether an odd number of sides lies between it and the outer face.
fn inside(triangulation: &ConstrainedDelaunayTriangulation<Point2<f64>>) -> Vec<bool> {
    let mut inside = vec![false; triangulation.num_all_faces()];
    let mut seen = inside.clone();
    let outer = triangulation.outer_face().fix();
    seen[outer.index()] = true;
    // The outer face has as many edges as the hull, so the first step goes over all of these.
    let mut open = Vec::new();
    for edge in triangulation.convex_hull() {
        open.push((edge.rev().face().fix(), edge.is_constraint_edge()));
    }
    while let Some((fixed, is_inside)) = open.pop() {
        if std::mem::replace(&mut seen[fixed.index()], true) {
            continue;
        }
        inside[fixed.index()] = is_inside;
        if let Some(face) = triangulation.face(fixed).as_inner() {
            for edge in face.adjacent_edges() {
                open.push((edge.rev().face().fix(), is_inside != edge.is_constraint_edge()));
            }
        }
    }
    inside
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sampled(corners: &[DVec2], step: f64) -> Vec<DVec2> {
        let sides = corners.iter().zip(corners.iter().cycle().skip(1));
        sides
            .flat_map(|(a, b)| {
                let parts = (a.distance(*b) / step).ceil();
                (0..parts as usize).map(move |k| a.lerp(*b, k as f64 / parts))
            })
            .collect()
    }

    #[test]
    fn a_strip_has_its_middle_line() {
        let corners = [(0.0, 0.0), (8.0, 0.0), (8.0, 1.0), (0.0, 1.0)].map(DVec2::from);
        let axis = ChordalAxis::of(&[sampled(&corners, 0.1)]).expect("a strip is simple");
        let far: Vec<_> = axis.nodes.iter().filter(|n| n.at.x > 0.6 && n.at.x < 7.4).collect();
        assert!(far.len() > 100);
        assert!(far.iter().all(|node| (node.at.y - 0.5).abs() < 1e-9));
        assert_eq!(axis.links.iter().map(Vec::len).sum::<usize>() % 2, 0);
    }

    #[test]
    fn a_frame_has_a_closed_axis_and_crossing_rings_have_none() {
        let square = |r: f64| [(-r, -r), (r, -r), (r, r), (-r, r)].map(DVec2::from);
        let axis =
            ChordalAxis::of(&[sampled(&square(5.0), 0.2), sampled(&square(4.0), 0.2)]).expect("simple");
        let inner = |n: &&AxisNode| n.at.abs().max_element() < 4.0 - 1e-9;
        assert_eq!(axis.nodes.iter().filter(inner).count(), 0, "the hole is not part of the region");
        assert!(axis.links.iter().all(|links| (1..=3).contains(&links.len())));
        let bow = [(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)].map(DVec2::from);
        assert!(ChordalAxis::of(&[bow.to_vec()]).is_none());
    }
}
