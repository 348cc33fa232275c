use crate::SliceError;
use crate::region::{parity_region, ring_points, rings};
use crate::settings::{LONGEST, MOST_LAYERS};
use argil_mesh::{Mesh, Soup};
use glam::DVec2;

/// Share of a layer's height that the walls of its body have. Bodies of neighbouring layers do not touch, so that each layer has
/// its own shells, whatever the others look like.
const SHARE: f64 = 0.75;

/// Contours smaller than this, in square millimetres, are rounding errors.
const LEAST_AREA: f64 = 1e-6;

/// A mesh that [`slice`](crate::slice) cuts into given layers: for those that come as polygons from another program.
///
/// Each layer is a list of closed contours in millimetres, bottom first; a point is solid where it lies inside an odd number of
/// them, so that contours may run either way round. Over each layer stand upright walls without floor or roof: cut at mid-layer,
/// they are the contours again, up to the polygon kernel's rounding (2⁻²⁹ of the layer's size). Layers without a contour at the bottom and
/// at the top do not count.
///
/// # Errors
/// [`SliceError::Setting`] for a layer height that is no length, [`SliceError::TooManyLayers`], [`SliceError::Contour`] for a
/// contour with a coordinate that is not finite, and [`SliceError::NoContours`] if nothing encloses anything.
///
/// # Complexity
/// Near linear in the points of each layer.
///
/// # Example
/// ```
/// use argil_slice::{SliceSettings, slice, stacked};
/// use glam::DVec2;
/// let square = |half: f64| vec![DVec2::new(-half, -half), DVec2::new(half, -half), DVec2::new(half, half), DVec2::new(-half, half)];
/// let mesh = stacked(&[vec![square(9.0), square(4.0)], vec![square(8.0)]], 0.5)?;
/// let layers = slice(&mesh, &SliceSettings::default())?;
/// assert_eq!(layers.iter().map(|layer| layer.walls.len()).collect::<Vec<_>>(), [2, 1]);
/// # Ok::<(), argil_slice::SliceError>(())
/// ```
pub fn stacked(layers: &[Vec<Vec<DVec2>>], layer_height: f64) -> Result<Mesh, SliceError> {
    if !(layer_height.is_normal() && layer_height > 0.0 && layer_height <= LONGEST) {
        return Err(SliceError::Setting { setting: "layer_height", value: layer_height });
    }
    if layers.len() > MOST_LAYERS {
        return Err(SliceError::TooManyLayers { layers: layers.len() as f64, limit: MOST_LAYERS });
    }
    for (layer, contours) in layers.iter().enumerate() {
        let is_far = |p: &DVec2| !p.to_array().iter().all(|value| value.abs() <= LONGEST);
        if let Some(contour) = contours.iter().position(|contour| contour.iter().any(is_far)) {
            return Err(SliceError::Contour { layer, contour, limit: LONGEST });
        }
    }
    let mut soup = Soup::default();
    let last = layers.iter().rposition(|contours| !contours.is_empty()).unwrap_or(0);
    for (layer, contours) in layers.iter().enumerate() {
        let low = layer as f64 * layer_height;
        let high = if layer == last { low + layer_height } else { low + SHARE * layer_height };
        for polygon in &parity_region(contours, LEAST_AREA) {
            for ring in rings(polygon) {
                wall(&ring_points(ring), [low, high], &mut soup)?;
            }
        }
    }
    Mesh::new(soup.vertices, soup.triangles).map_err(|_| SliceError::NoContours)
}

/// An upright wall along a ring, whose left is inside.
fn wall(ring: &[DVec2], heights: [f64; 2], soup: &mut Soup) -> Result<(), SliceError> {
    let first = soup.vertices.len();
    let count = ring.len();
    // Four bytes name a vertex.
    if u32::try_from(first + 2 * count).is_err() {
        return Err(SliceError::TooManyPoints { limit: u32::MAX as usize / 2 });
    }
    soup.vertices.extend(heights.iter().flat_map(|&z| ring.iter().map(move |p| [p.x, p.y, z])));
    for k in 0..count {
        let next = (k + 1) % count;
        let [a, b, c, d] = [k, next, count + next, count + k].map(|corner| (first + corner) as u32);
        soup.triangles.extend([[a, b, c], [a, c, d]]);
    }
    Ok(())
}
