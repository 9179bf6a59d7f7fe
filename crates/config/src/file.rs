//! Files that users name: regular files, built-in files, and pipes from other programs.

use std::collections::BTreeMap;
use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::{fs, io};

use crate::fault::Fault;

/// A file's text.
///
/// # Errors
/// If it cannot be read, or is not UTF-8.
pub fn read_text(path: &Path) -> Result<String, Fault> {
    String::from_utf8(read_bytes(path)?).map_err(|error| unreadable(path, error))
}

/// The bytes of a regular file, of a built-in file, or of what another program pipes into this one.
///
/// # Errors
/// If it cannot be read, or may never end.
pub fn read_bytes(path: &Path) -> Result<Vec<u8>, Fault> {
    if let Some(bytes) = shipped::file(path) {
        return Ok(bytes.to_vec());
    }
    let read = || {
        let kind = fs::metadata(path)?.file_type();
        if kind.is_file() {
            return fs::read(path);
        }
        // A pipe between programs is not in any folder. A device such as /dev/zero has no end, and a named
        // pipe may have no writer.
        if is_pipe(kind) && fs::canonicalize(path).is_err() {
            return read_pipe(path);
        }
        Err(io::Error::other("not a regular file"))
    };
    read().map_err(|error| unreadable(path, error))
}

/// The bytes of a pipe. They are kept: they can be taken from it only once.
fn read_pipe(path: &Path) -> io::Result<Vec<u8>> {
    static READ: Mutex<BTreeMap<PathBuf, Vec<u8>>> = Mutex::new(BTreeMap::new());
    let mut read = READ.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(bytes) = read.get(path) {
        return Ok(bytes.clone());
    }
    let bytes = fs::read(path)?;
    read.insert(path.to_owned(), bytes.clone());
    Ok(bytes)
}

#[cfg(unix)]
fn is_pipe(kind: fs::FileType) -> bool {
    std::os::unix::fs::FileTypeExt::is_fifo(&kind)
}

#[cfg(not(unix))]
fn is_pipe(_: fs::FileType) -> bool {
    false
}

/// The fault of a file that cannot be read.
pub fn unreadable(path: &Path, error: impl Display) -> Fault {
    Fault::of_file(path.display(), format!("cannot be read: {error}"))
}

#[cfg(all(test, unix))]
mod tests {
    use std::os::fd::AsRawFd;

    use super::*;

    #[test]
    fn a_pipe_can_be_read_repeatedly_and_a_device_never() {
        let (reader, mut writer) = io::pipe().unwrap();
        io::Write::write_all(&mut writer, b"{}").unwrap();
        drop(writer);
        let path = PathBuf::from(format!("/dev/fd/{}", reader.as_raw_fd()));
        assert_eq!(read_bytes(&path).unwrap(), b"{}");
        assert_eq!(read_text(&path).unwrap(), "{}");
        for other in ["/dev/zero", "/dev"] {
            let fault = read_bytes(Path::new(other)).unwrap_err().to_string();
            assert_eq!(fault, format!("{other}: cannot be read: not a regular file"));
        }
    }
}
