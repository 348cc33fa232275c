use crate::model::holds;

/// Reads the bytes as an OBJ file.
pub fn read_obj(bytes: &[u8]) {
    holds(argil_mesh::obj(bytes));
}
