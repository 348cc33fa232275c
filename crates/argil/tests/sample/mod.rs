//! Bundled models as meshes.

use argil::mesh::{Mesh, read_stl};

/// The bundled model of a name, by way of the bytes of its STL file.
pub(crate) fn sample(name: &str) -> Mesh {
    let solid = argil_models::by_name(name).expect("the model is bundled");
    read_stl(&solid.to_stl()).expect("bundled models are sound meshes")
}
