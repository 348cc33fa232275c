use argil_mesh::{Ground, Mesh, Placement, Size};

/// Reads the bytes as an STL file: an error, or a mesh whose triangles are triangles and which can be worked with.
pub fn read_stl(bytes: &[u8]) {
    let Ok(mesh) = argil_mesh::read_stl(bytes) else { return };
    holds_together(&mesh);
    let oriented = mesh.oriented();
    holds_together(&oriented);
    assert_eq!(mesh.triangles().len(), oriented.triangles().len());
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
