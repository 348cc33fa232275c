use argil_mesh::{Soup, Unit};
use geo::TriangulateEarcut;
use geo_types::{Coord, Polygon};

use crate::Layer;
use crate::region::{inset, mitred_dilation, rings};

/// Half the width of what is left out, in layer heights: no bead shows it, and in single precision its two sides would cross.
const SLIVER: f64 = 1e-3;

/// The outlines of layers as upright prisms, each as high as its layer: what was made of a mesh, to look at and to measure against.
///
/// Cut at the middle of its layers it is the outlines again, without a gap and without an overlap. Each polygon is a closed body
/// of its own; floors and roofs are cut into triangles by ears. What is thinner than a five-hundredth of a layer's height is left out.
///
/// # Complexity
/// Near linear in the vertices of the outlines, up to quadratic for the roofs of odd ones.
///
/// # Example
/// ```
/// use argil_slice::{SliceSettings, prisms, slice, stacked};
/// use glam::DVec2;
/// let square = vec![DVec2::ZERO, DVec2::new(8.0, 0.0), DVec2::new(8.0, 8.0), DVec2::new(0.0, 8.0)];
/// let layers = slice(&stacked(&[vec![square]], 0.5)?, &SliceSettings::default())?;
/// let (mesh, repairs) = prisms(&layers).repaired().unwrap();
/// assert_eq!((mesh.triangles().len(), repairs.open_edges.count), (12, 0));
/// assert!((mesh.signed_volume() - 32.0).abs() < 1e-6);
/// # Ok::<(), argil_slice::SliceError>(())
/// ```
#[must_use]
pub fn prisms(layers: &[Layer]) -> Soup {
    let mut soup = Soup { unit: Some(Unit::Millimetre), ..Soup::default() };
    for layer in layers {
        // The cut is at the middle of the layer.
        let heights = [2.0 * layer.cut_z - layer.print_z, layer.print_z];
        let sliver = SLIVER * (heights[1] - heights[0]);
        for polygon in &mitred_dilation(&inset(&layer.outline, sliver, 0.1 * sliver), sliver) {
            prism(polygon, heights, &mut soup);
        }
    }
    soup
}

fn prism(polygon: &Polygon<f64>, [low, high]: [f64; 2], soup: &mut Soup) {
    let mut face = |corners: [(Coord<f64>, f64); 3]| {
        // Bodies beyond four thousand million vertices are beyond any memory as well.
        let Ok(end) = u32::try_from(soup.vertices.len() + 3) else { return };
        soup.vertices.extend(corners.map(|(p, z)| [p.x, p.y, z]));
        soup.triangles.push([end - 3, end - 2, end - 1]);
    };
    // The first ring runs counter-clockwise and the others clockwise, so that the solid is on the left of all.
    for side in rings(polygon).flat_map(|ring| ring.lines()).filter(|side| side.start != side.end) {
        let (a, b) = (side.start, side.end);
        face([(a, low), (b, low), (b, high)]);
        face([(a, low), (b, high), (a, high)]);
    }
    for triangle in polygon.earcut_triangles() {
        let [a, b, c] = triangle.to_array();
        let area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        let [b, c] = if area < 0.0 { [c, b] } else { [b, c] };
        face([(a, high), (b, high), (c, high)]);
        face([(a, low), (c, low), (b, low)]);
    }
}
