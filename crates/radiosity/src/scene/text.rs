//! Text files, and line numbers in them.

use std::io;
use std::path::Path;

use super::error::SceneError;

/// A function that reads the bytes of a file, from disk or from elsewhere.
pub(crate) type Reader<'a> = &'a dyn Fn(&Path) -> io::Result<Vec<u8>>;

/// Reads a file as text. Bytes that are not UTF-8, as in old encodings, become U+FFFD.
pub(crate) fn read(path: &Path, reader: Reader) -> io::Result<String> {
    let bytes = reader(path)?;
    Ok(String::from_utf8_lossy(&bytes).trim_start_matches('\u{feff}').to_owned())
}

/// An error at a line (counted from 1) of a file.
pub(crate) fn wrong(path: &Path, line: Option<usize>, problem: String) -> SceneError {
    let line = line.map_or_else(String::new, |line| format!(":{line}"));
    SceneError::InFile { place: format!("{}{line}", path.display()), problem }
}
