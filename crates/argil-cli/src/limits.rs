//! How much of a model is taken: told before the work begins, not when the memory is full.

use std::path::Path;

use argil::mesh::Mesh;

use crate::failure::Failure;

/// The largest model file in bytes.
const LARGEST_FILE: u64 = 4 << 30;

/// The most triangles: by the estimate below they take 3 GB before a layer is cut.
const MOST_TRIANGLES: usize = 20_000_000;

/// The most points of one layer's outlines: planning takes longer than in proportion to them.
const MOST_POINTS: usize = 1_000_000;

/// Bytes that slicing is reckoned to take for a triangle and for a point that a layer cuts: above what was measured. Wavy vases as binary STL took at
/// most 43 MB (251,000 triangles, 100,000 points; 45 by the estimate), 197 MB (1,252,000 triangles, 1,000,000 points; 258) and
/// 932 MB (5,004,000 triangles, 8,002,000 points; 1,311).
const BYTES_PER_TRIANGLE: usize = 150;
const BYTES_PER_POINT: usize = 70;

/// Refuses a file that is larger than any model.
pub(crate) fn check_file(path: &Path) -> Result<(), Failure> {
    // What cannot be asked for its size is told when it is read.
    let Ok(found) = std::fs::metadata(path) else { return Ok(()) };
    within(path, "a file", found.len(), LARGEST_FILE, "bytes")
}

/// Refuses a mesh that is cut into more than can be planned, or that takes more memory than it may.
pub(crate) fn check_mesh(path: &Path, mesh: &Mesh, layer_height: f64, gibibytes: f64) -> Result<(), Failure> {
    let triangles = mesh.triangles().len();
    within(path, "a model", triangles as u64, MOST_TRIANGLES as u64, "triangles")?;
    let points = points(mesh, layer_height);
    let most = points.iter().copied().max().unwrap_or(0);
    within(path, "a layer", most as u64, MOST_POINTS as u64, "points")?;
    let bytes = BYTES_PER_TRIANGLE * triangles + BYTES_PER_POINT * points.iter().sum::<usize>();
    let needed = bytes as f64 / f64::from(1 << 30);
    if needed > gibibytes {
        return Err(Failure::Memory { name: path.display().to_string(), needed, given: gibibytes });
    }
    Ok(())
}

fn within(
    path: &Path,
    what: &'static str,
    found: u64,
    limit: u64,
    unit: &'static str,
) -> Result<(), Failure> {
    if found <= limit {
        return Ok(());
    }
    Err(Failure::TooLarge { name: path.display().to_string(), what, found, limit, unit })
}

/// How many edges of triangles each layer cuts: its points before any is left out.
fn points(mesh: &Mesh, layer_height: f64) -> Vec<usize> {
    let bounds = mesh.bounds();
    let layers = (bounds.size()[2] / layer_height + 0.5).floor();
    // Layers beyond any print are refused by the slicer, with their number.
    let most = 100_000.0;
    if !(1.0..=most).contains(&layers) {
        return Vec::new();
    }
    let layers = layers as usize;
    // Where the number of cut triangles rises and falls.
    let mut steps = vec![0_i64; layers + 1];
    for corners in mesh.triangles() {
        let heights = corners.map(|k| mesh.vertices()[k as usize][2] - bounds.min[2]);
        let plane = |z: f64| ((z / layer_height + 0.5).floor().max(0.0) as usize).min(layers);
        let low = plane(heights.iter().copied().fold(f64::INFINITY, f64::min));
        let high = plane(heights.iter().copied().fold(f64::NEG_INFINITY, f64::max));
        steps[low] += 1;
        steps[high] -= 1;
    }
    let mut cut = 0;
    steps[..layers]
        .iter()
        .map(|step| {
            cut += step;
            usize::try_from(cut).unwrap_or(0)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_counted_by_layer() {
        let corners = vec![[0.0; 3], [9.0, 0.0, 0.0], [0.0, 9.0, 0.0], [0.0, 0.0, 2.0]];
        let mesh = Mesh::new(corners, vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]).unwrap();
        // Each plane meets three sides of a tetrahedron.
        assert_eq!(points(&mesh, 0.5), [3, 3, 3, 3]);
        assert!(points(&mesh, 1e-9).is_empty());
        assert!(check_mesh(Path::new("a"), &mesh, 0.5, 4.0).is_ok());
        assert!(matches!(check_mesh(Path::new("a"), &mesh, 0.5, 1e-9), Err(Failure::Memory { .. })));
    }
}
