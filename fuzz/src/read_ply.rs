use crate::model::holds;

/// Reads the bytes as a PLY file.
pub fn read_ply(bytes: &[u8]) {
    holds(argil_mesh::ply(bytes));
}
