use thiserror::Error;

fn at_line(line: usize) -> String {
    if line == 0 { String::new() } else { format!("line {line}: ") }
}

fn at_byte(position: u64) -> String {
    if position == 0 { String::new() } else { format!(", byte {position}") }
}

/// Why bytes are no mesh, or why a mesh cannot be placed.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum MeshError {
    /// There are no bytes at all.
    #[error("the file is empty")]
    Empty,
    /// A binary STL whose length does not fit the triangle count in its header.
    ///
    /// Reading what is there would print part of a model without a word, so neither a short nor a
    /// long file is accepted.
    #[error("the header declares {declared} triangles, but the file holds {present} ({extra} bytes over)")]
    Truncated {
        /// The count in the header.
        declared: u64,
        /// How many whole triangles follow the header.
        present: u64,
        /// Bytes after the last whole triangle.
        extra: u64,
    },
    /// A file that does not follow its format.
    #[error("{}expected {expected}", at_line(*line))]
    Unreadable {
        /// The line of the text, counted from 1 (0 where the file is no text).
        line: usize,
        /// What should have stood there.
        expected: &'static str,
    },
    /// A part of a 3MF package that does not follow the format.
    #[error("{part}{}: expected {expected}", at_byte(*position))]
    Package {
        /// The name of the part.
        part: String,
        /// The byte of the part where it goes wrong (0 where it is wrong as a whole).
        position: u64,
        /// What should have been there.
        expected: &'static str,
    },
    /// A part of a 3MF package that unpacks to more than a mesh may take, or than its packed size makes likely.
    #[error("{part} unpacks to more than {limit} bytes")]
    Unpacked {
        /// The name of the part.
        part: String,
        /// The limit in bytes.
        limit: u64,
    },
    /// Something that the format allows and that is not read here.
    #[error("not supported: {what}")]
    Unsupported {
        /// What, and what would do.
        what: String,
    },
    /// The file is well formed, but no triangle has three different corners.
    #[error("no triangle with three different corners")]
    NoTriangles,
    /// A coordinate that is not a number, is infinite, or is beyond what arithmetic on lengths can carry.
    #[error("triangle {triangle} has a coordinate that is not finite or is beyond {limit:e} mm", limit = crate::mesh::LARGEST)]
    NotFinite {
        /// Index of the triangle, in file order.
        triangle: usize,
    },
    /// A triangle names a vertex that does not exist.
    #[error("triangle {triangle} names vertex {vertex}, which does not exist")]
    NoSuchVertex {
        /// Index of the triangle.
        triangle: usize,
        /// The index it names.
        vertex: u32,
    },
    /// More vertices than 32-bit indices can tell apart.
    #[error("{count} corners are more than 32-bit indices can name")]
    TooMany {
        /// How many corners were given.
        count: usize,
    },
    /// A scale factor that is not a positive finite number.
    #[error("cannot scale by {factor}")]
    Scale {
        /// The factor that was asked for.
        factor: f64,
    },
    /// A target height that is not a positive finite number, or that a mesh of this height cannot be scaled to.
    #[error("cannot scale a mesh of height {from} mm to {to} mm")]
    Height {
        /// The height of the mesh in millimetres.
        from: f64,
        /// The height that was asked for in millimetres.
        to: f64,
    },
    /// A place on the bed that is not finite.
    #[error("cannot stand at ({x}, {y})")]
    Place {
        /// Its x in millimetres.
        x: f64,
        /// Its y in millimetres.
        y: f64,
    },
}
