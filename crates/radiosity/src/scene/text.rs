//! Text files, and line numbers and names in them.

use std::path::Path;
use std::{fs, io};

use super::error::SceneError;

/// A function that reads the bytes of a file, from disk or from elsewhere.
pub(crate) type Reader<'a> = &'a dyn Fn(&Path) -> io::Result<Vec<u8>>;

/// Reads the bytes of a regular file. Devices and pipes, which may never end, are refused.
///
/// # Errors
/// If the file cannot be read or is not a regular file.
pub fn read_regular_file(path: &Path) -> io::Result<Vec<u8>> {
    if !fs::metadata(path)?.is_file() {
        return Err(io::Error::other("not a regular file"));
    }
    fs::read(path)
}

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

/// Numbers without a comment.
pub(crate) fn numbers(line: &str) -> &str {
    line.split('#').next().unwrap_or_default().trim_end()
}

/// A name without a comment. A `#` begins a comment if a space is before it, and a space or nothing
/// after it: "chair #2" is a name.
pub(crate) fn name(text: &str) -> &str {
    before_comment(text, |after| after.is_none_or(char::is_whitespace))
}

/// The text before the first `#` that has a space before it.
pub(crate) fn without_comment(text: &str) -> &str {
    before_comment(text, |_| true)
}

fn before_comment(text: &str, begins: impl Fn(Option<char>) -> bool) -> &str {
    let comment = text.match_indices('#').find(|&(at, _)| {
        let before = text[..at].chars().next_back();
        before.is_none_or(char::is_whitespace) && begins(text[at + 1..].chars().next())
    });
    comment.map_or(text, |(at, _)| &text[..at]).trim()
}
