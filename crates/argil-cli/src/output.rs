//! Files that are written whole or not at all.

use std::fmt::Display;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::failure::Failure;

/// Whether a place is `-`, standard output.
pub(crate) fn is_standard(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Writes to standard output. That a reader has seen enough and left is no failure.
pub(crate) fn print(what: &'static str, text: &[u8]) -> Result<(), Failure> {
    match io::stdout().lock().write_all(text) {
        Err(source) if source.kind() != io::ErrorKind::BrokenPipe => {
            Err(Failure::Output { what, source: Box::new(source) })
        }
        _ => Ok(()),
    }
}

/// Tells a line on standard error, if anybody listens there.
pub(crate) fn tell(line: impl Display) {
    drop(writeln!(io::stderr(), "{line}"));
}

/// Writes a file beside its place and moves it there, so that the final name never stands for half a file. What goes to
/// standard output ends with its line.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    if is_standard(path) {
        let end: &[u8] = if bytes.ends_with(b"\n") { b"" } else { b"\n" };
        return print("file", bytes).and_then(|()| print("file", end));
    }
    let failed = |source| Failure::writing(path, source);
    // A link is followed, and what is no file, as `/dev/null`, is written to and not replaced.
    let place = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    if fs::metadata(&place).is_ok_and(|found| !found.is_file()) {
        return fs::write(&place, bytes).map_err(failed);
    }
    let (partial, mut file) = partial(&place).map_err(failed)?;
    let written =
        file.write_all(bytes).and_then(|()| file.sync_all()).and_then(|()| fs::rename(&partial, &place));
    written.map_err(|source| {
        // What is left of a failed write is of no use; that it may be gone already is no second failure.
        drop(fs::remove_file(&partial));
        failed(source)
    })
}

/// A new file beside a place, under a name that nothing has.
fn partial(place: &Path) -> io::Result<(PathBuf, File)> {
    const TRIES: u32 = 100;
    let mut number = 0;
    loop {
        let mut name = place.as_os_str().to_owned();
        name.push(format!(".{}-{number}.part", std::process::id()));
        match File::create_new(&name) {
            Ok(file) => return Ok((name.into(), file)),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists && number < TRIES => number += 1,
            Err(error) => return Err(error),
        }
    }
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
