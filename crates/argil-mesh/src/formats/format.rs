use std::fmt;

use crate::formats::obj::obj;
use crate::formats::ply::ply;
use crate::formats::stl::{is_whole_binary, stl};
#[cfg(feature = "3mf")]
use crate::formats::three_mf::three_mf;
use crate::{MeshError, Soup};

/// A format of model files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Format {
    /// STL, binary or text.
    Stl,
    /// Wavefront OBJ.
    Obj,
    /// PLY, text or binary.
    Ply,
    /// 3MF, a package of XML.
    ThreeMf,
}

impl Format {
    /// The format of a file by what it holds, and by the extension of its name (without the dot, in any case) where its
    /// contents do not tell.
    ///
    /// # Example
    /// ```
    /// use argil_mesh::Format;
    /// assert_eq!(Format::of(b"ply\nformat ascii 1.0\n", Some("stl")), Some(Format::Ply));
    /// assert_eq!(Format::of(b"# made by hand\nv 0 0 0\n", None), Some(Format::Obj));
    /// assert_eq!(Format::of(b"ISO-10303-21;", Some("step")), None);
    /// ```
    #[must_use]
    pub fn of(bytes: &[u8], extension: Option<&str>) -> Option<Self> {
        let named = match extension.map(str::to_ascii_lowercase).as_deref() {
            Some("stl") => Some(Self::Stl),
            Some("obj") => Some(Self::Obj),
            Some("ply") => Some(Self::Ply),
            Some("3mf") => Some(Self::ThreeMf),
            _ => None,
        };
        if is_whole_binary(bytes) {
            return Some(Self::Stl);
        }
        if bytes.starts_with(b"PK\x03\x04") {
            return Some(Self::ThreeMf);
        }
        let text = bytes.trim_ascii_start();
        let begins = |word: &[u8]| {
            text.len() > word.len() && text.starts_with(word) && text[word.len()].is_ascii_whitespace()
        };
        if begins(b"ply") {
            return Some(Self::Ply);
        }
        if begins(b"solid") {
            return Some(Self::Stl);
        }
        named.or_else(|| first_statement_is_obj(bytes).then_some(Self::Obj))
    }

    /// The triangles of a file of this format.
    ///
    /// # Errors
    /// Those of the reader of the format; [`MeshError::Unsupported`] for 3MF without the feature `3mf`.
    pub fn read(self, bytes: &[u8]) -> Result<Soup, MeshError> {
        match self {
            Self::Stl => stl(bytes),
            Self::Obj => obj(bytes),
            Self::Ply => ply(bytes),
            #[cfg(feature = "3mf")]
            Self::ThreeMf => three_mf(bytes),
            #[cfg(not(feature = "3mf"))]
            Self::ThreeMf => {
                Err(MeshError::Unsupported { what: "3MF: this was built without it".to_owned() })
            }
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Stl => "STL",
            Self::Obj => "OBJ",
            Self::Ply => "PLY",
            Self::ThreeMf => "3MF",
        })
    }
}

/// Whether the first line that is no comment begins with a word of OBJ.
fn first_statement_is_obj(bytes: &[u8]) -> bool {
    let lines = bytes.split(|&byte| byte == b'\n' || byte == b'\r').map(<[u8]>::trim_ascii_start);
    let first = lines.take(1000).find(|line| !line.is_empty() && !line.starts_with(b"#"));
    let word = first.and_then(|line| line.split(u8::is_ascii_whitespace).next());
    word.is_some_and(|word| {
        matches!(word, b"v" | b"vn" | b"vt" | b"f" | b"o" | b"g" | b"s" | b"mtllib" | b"usemtl")
    })
}
