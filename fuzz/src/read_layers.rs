use argil_layers::{SvgSettings, is_svg, json, svg};
use argil_slice::stacked;

/// Most points of which a mesh is made: it takes longer than reading them.
const MOST_POINTS: usize = 2_000;

/// Reads layers in SVG or JSON: what is read is finite, and a mesh of it has the layers.
pub fn read_layers(bytes: &[u8]) {
    let is_svg = is_svg(bytes);
    let read = if is_svg { svg(bytes, &SvgSettings::default()) } else { json(bytes, None) };
    let layers = match read {
        Ok(layers) => layers,
        Err(error) => {
            assert!(!error.to_string().is_empty());
            return;
        }
    };
    let contours = || layers.layers.iter().flatten();
    if is_svg {
        assert!(contours().all(|contour| contour.len() > 2), "a contour encloses nothing");
        assert!(contours().flatten().all(|p| p.abs().max_element() <= 1e6), "a point is far");
    }
    if contours().map(Vec::len).sum::<usize>() > MOST_POINTS || layers.layers.len() > MOST_POINTS {
        return;
    }
    let height = layers.layer_height.unwrap_or(0.5);
    let Ok(mesh) = stacked(&layers.layers, height) else { return };
    let bounds = mesh.bounds();
    assert!(bounds.size()[2] <= height * layers.layers.len() as f64 * (1.0 + 1e-9));
    assert!(mesh.vertices().iter().flatten().all(|value| value.is_finite()));
}
