//! Text files, and line numbers in them.

use std::io::{self, BufRead, Read};
use std::path::Path;

use super::error::SceneError;

/// A function that reads the bytes of a file, from disk or from elsewhere.
pub(crate) type Reader<'a> = &'a dyn Fn(&Path) -> io::Result<Vec<u8>>;

/// Reads a file as text. Bytes that are not UTF-8 become U+FFFD, so that names in old encodings are
/// accepted.
pub(crate) fn read(path: &Path, reader: Reader) -> io::Result<String> {
    let bytes = reader(path)?;
    Ok(String::from_utf8_lossy(&bytes).trim_start_matches('\u{feff}').to_owned())
}

/// An error at a line (counted from 1) of a file.
pub(crate) fn wrong(path: &Path, line: Option<usize>, problem: String) -> SceneError {
    let line = line.map_or_else(String::new, |line| format!(":{line}"));
    SceneError::InFile { place: format!("{}{line}", path.display()), problem }
}

/// A reader that counts the lines that were read from it.
pub(crate) struct Lines<'a> {
    /// Bytes not read yet.
    pub(crate) rest: &'a [u8],
    /// Lines read.
    pub(crate) read: usize,
}

impl BufRead for Lines<'_> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        Ok(self.rest)
    }

    fn consume(&mut self, amount: usize) {
        let (read, rest) = self.rest.split_at(amount);
        self.read += read.iter().filter(|&&byte| byte == b'\n').count();
        self.rest = rest;
    }
}

impl Read for Lines<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let amount = self.fill_buf()?.read(buffer)?;
        self.consume(amount);
        Ok(amount)
    }
}
