//! The parts of a 3MF file, which is a ZIP archive.

use std::io::Read;

use flate2::read::DeflateDecoder;
use rawzip::{CompressionMethod, ZipArchive, ZipSliceArchive};

use crate::MeshError;

/// The most bytes that all parts together may unpack to: three times what a mesh of five million triangles takes.
const MOST_UNPACKED: u64 = 1 << 30;

/// Parts that unpack to less than this may be packed as well as they like.
const FREE: u64 = 16 << 20;

/// How many times its packed size a larger part may have: XML of meshes is packed five to twenty times.
const MOST_RATIO: u64 = 200;

/// The most parts that are listed.
const MOST_PARTS: usize = 100_000;

pub(crate) struct Package<'a> {
    archive: ZipSliceArchive<&'a [u8]>,
    /// How much may still be unpacked.
    left: u64,
}

impl<'a> Package<'a> {
    pub(crate) fn open(bytes: &'a [u8]) -> Result<Self, MeshError> {
        let archive = ZipArchive::from_slice(bytes).map_err(|_| broken("3MF file", "a whole ZIP archive"))?;
        Ok(Self { archive, left: MOST_UNPACKED })
    }

    /// The text of a part, whose name has no regard to case; `None` if there is no such part.
    ///
    /// What it unpacks to is limited, so that a small file cannot fill the memory.
    pub(crate) fn part(&mut self, name: &str) -> Result<Option<String>, MeshError> {
        let mut entries = self.archive.entries();
        for _ in 0..MOST_PARTS {
            let entry = entries.next_entry().map_err(|_| broken(name, "a whole ZIP directory"))?;
            let Some(entry) = entry else { return Ok(None) };
            let found = entry.file_path();
            let found: &[u8] = found.as_ref();
            if !found.strip_prefix(b"/").unwrap_or(found).eq_ignore_ascii_case(name.as_bytes()) {
                continue;
            }
            let method = entry.compression_method();
            let found = self.archive.get_entry(entry.wayfinder());
            let found = found.map_err(|_| broken(name, "the part that the ZIP directory names"))?;
            let packed = found.data();
            let limit = self.left.min(FREE.max((packed.len() as u64).saturating_mul(MOST_RATIO)));
            let mut text = Vec::new();
            let read = match method {
                CompressionMethod::STORE => {
                    found.verifying_reader(packed).take(limit + 1).read_to_end(&mut text)
                }
                CompressionMethod::DEFLATE => {
                    found.verifying_reader(DeflateDecoder::new(packed)).take(limit + 1).read_to_end(&mut text)
                }
                _ => {
                    return Err(MeshError::Unsupported {
                        what: format!("{name}: another packing than deflate"),
                    });
                }
            };
            if text.len() as u64 > limit {
                return Err(MeshError::Unpacked { part: name.to_owned(), limit });
            }
            read.map_err(|_| {
                broken(name, "a part that can be unpacked, of the size and checksum in the directory")
            })?;
            self.left -= text.len() as u64;
            return match String::from_utf8(text) {
                Ok(text) => Ok(Some(text)),
                Err(_) => Err(broken(name, "XML in UTF-8")),
            };
        }
        Err(broken(name, "a directory of at most 100,000 parts"))
    }
}

pub(crate) fn broken(part: &str, expected: &'static str) -> MeshError {
    MeshError::Package { part: part.to_owned(), position: 0, expected }
}
