use crate::model::holds;

/// Reads the bytes as an STL file.
pub fn read_stl(bytes: &[u8]) {
    holds(argil_mesh::stl(bytes));
}
