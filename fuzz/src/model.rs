//! What must hold of every model file that is read.

use argil_mesh::{Ground, Mesh, MeshError, Placement, Size, Soup};

/// Makes a mesh of what was read: an error, or a mesh whose triangles are triangles and which can be worked with.
pub(crate) fn holds(read: Result<Soup, MeshError>) {
    let Ok(soup) = read else { return };
    let count = soup.triangles.len();
    let Ok((mesh, repairs)) = soup.repaired() else { return };
    holds_together(&mesh);
    let dropped = repairs.degenerate.count + repairs.duplicates.count + repairs.inner_faces.count;
    assert_eq!(mesh.triangles().len() + dropped, count, "a triangle was dropped without a word");
    let defects = repairs.listed().into_iter().map(|(_, places)| places);
    assert!(defects.flat_map(|places| &places.first).flatten().all(|value| value.is_finite()));
    assert_eq!(mesh.oriented(), mesh, "what is repaired faces outwards");
    let placement = Placement { size: Size::Height(20.0), ground: Ground::Centre };
    if let Ok(placed) = mesh.placed(&placement) {
        holds_together(&placed);
        assert_eq!(placed.bounds().min[2], 0.0);
        assert_eq!(placed.bounds().max[2], 20.0);
    }
    // What the reader made is a mesh by the constructor's own rules.
    Mesh::new(mesh.vertices().to_vec(), mesh.triangles().to_vec()).expect("a mesh is a mesh");
}

fn holds_together(mesh: &Mesh) {
    let count = mesh.vertices().len();
    assert!(!mesh.triangles().is_empty(), "a mesh has triangles");
    assert!(mesh.vertices().iter().flatten().all(|value| value.is_finite()));
    for &[a, b, c] in mesh.triangles() {
        assert!([a, b, c].iter().all(|&k| (k as usize) < count), "a corner does not exist");
        assert!(a != b && b != c && c != a, "a triangle has two corners in one place");
    }
    assert!(mesh.signed_volume().is_finite());
    let _ = mesh.edges();
}
