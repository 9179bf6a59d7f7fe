//! Files: read with a message that names them, written whole or not at all.

use config::{Fault, unreadable};
use std::fs;
use std::io;
use std::path::Path;

pub const PLAIN: &str = "letters, digits, \"-\", \"_\" and \".\", the first one no \".\"";

/// Whether a name is one file in the folder where it is put, and no hidden one.
pub fn is_plain(name: &str) -> bool {
    let plain = |c: char| c.is_alphanumeric() || "-_.".contains(c);
    !name.is_empty() && name.len() <= 100 && !name.starts_with('.') && name.chars().all(plain)
}

pub fn read(path: &Path) -> Result<Vec<u8>, Fault> {
    fs::read(path).map_err(|error| unreadable(path, error))
}

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_plain_leads_elsewhere() {
        for name in ["table1", "speed_up-by-stop.patch_threshold", "größe"] {
            assert!(is_plain(name), "{name}");
        }
        for name in ["", ".", "..", "../x", "/etc/x", "a/b", "a\\b", "C:x", ".partial", "a b"] {
            assert!(!is_plain(name), "{name}");
        }
    }
}
