//! Files that are either whole or not there.

use std::fs;
use std::io;
use std::path::Path;

/// Writes a file under a temporary name beside it and then renames it: a reader, or a run that
/// was killed, never sees half of it.
///
/// # Errors
/// The system's, with the file's name.
pub fn write(path: &Path, contents: &[u8]) -> io::Result<()> {
    let mut temporary = path.as_os_str().to_owned();
    temporary.push(format!(".{}.tmp", std::process::id()));
    let written = fs::write(&temporary, contents).and_then(|()| fs::rename(&temporary, path));
    written.map_err(|error| {
        let _ = fs::remove_file(&temporary);
        io::Error::new(error.kind(), format!("{}: cannot be written: {error}", path.display()))
    })
}
