//! Files that are written whole or not at all.

use std::io::Write;
use std::path::Path;
use std::{fs, io};

use crate::failure::Failure;

/// Whether a place is `-`, standard output.
pub(crate) fn is_standard(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Writes a file beside its place and moves it there, so that the final name never stands for half a file. What goes to
/// standard output ends with its line.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    if is_standard(path) {
        let mut out = io::stdout().lock();
        return out
            .write_all(bytes)
            .and_then(|()| if bytes.ends_with(b"\n") { Ok(()) } else { out.write_all(b"\n") })
            .map_err(|source| Failure::writing(path, source));
    }
    let mut partial = path.as_os_str().to_owned();
    partial.push(".part");
    let partial = Path::new(&partial);
    fs::write(partial, bytes).and_then(|()| fs::rename(partial, path)).map_err(|source| {
        // What is left of a failed write is of no use; that it may be gone already is no second failure.
        drop(fs::remove_file(partial));
        Failure::writing(path, source)
    })
}

/// Refuses a place where nothing can be written, so that a long plan does not end there.
pub(crate) fn check(path: &Path) -> Result<(), Failure> {
    if is_standard(path) {
        return Ok(());
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let refuse = |kind: io::ErrorKind| Err(Failure::writing(path, kind.into()));
    match fs::metadata(folder) {
        Err(source) => Err(Failure::writing(path, source)),
        Ok(found) if !found.is_dir() => refuse(io::ErrorKind::NotADirectory),
        Ok(_) if path.is_dir() => refuse(io::ErrorKind::IsADirectory),
        Ok(_) => Ok(()),
    }
}

/// Makes a folder and those above it.
pub(crate) fn folder(path: &Path) -> Result<(), Failure> {
    fs::create_dir_all(path).map_err(|source| Failure::writing(path, source))
}
