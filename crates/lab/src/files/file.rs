//! Files: read with a message that names them, written whole or not at all.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

pub const PLAIN: &str = "letters, digits, \"-\", \"_\" and \".\", the first one no \".\"";

/// Whether a name is one file in the folder where it is put, and no hidden one.
pub fn is_plain(name: &str) -> bool {
    let plain = |c: char| c.is_alphanumeric() || "-_.".contains(c);
    !name.is_empty() && name.len() <= 100 && !name.starts_with('.') && name.chars().all(plain)
}

/// Where a file at this path is written. A link is followed; a device or a named pipe, which a file would
/// replace, is refused.
///
/// # Errors
/// If there is something else than a regular file, or a link that leads to none.
pub fn target(path: &Path) -> io::Result<PathBuf> {
    let refused = |why: &str| named(path, "cannot be written", &io::Error::other(why));
    match (fs::symlink_metadata(path), fs::metadata(path)) {
        (Ok(link), Ok(end)) if link.is_symlink() && end.is_file() => {
            fs::canonicalize(path).map_err(|error| named(path, "cannot be written", &error))
        }
        (_, Ok(end)) if end.is_file() => Ok(path.to_owned()),
        (_, Ok(end)) if end.is_dir() => Err(refused("it is a folder")),
        (_, Ok(_)) => Err(refused("not a regular file")),
        (Ok(_), Err(_)) => Err(refused("a link that leads to no file")),
        (Err(_), Err(_)) => Ok(path.to_owned()),
    }
}

/// Writes a file under a temporary name beside its target and then renames it: a reader, or a run that
/// was killed, never sees half of it.
///
/// # Errors
/// Those of [`target`], and the system's, with the file's name.
pub fn write(path: &Path, contents: &[u8]) -> io::Result<()> {
    let path = &target(path)?;
    let mut temporary = path.as_os_str().to_owned();
    temporary.push(format!(".{}.tmp", std::process::id()));
    let written = fs::write(&temporary, contents).and_then(|()| fs::rename(&temporary, path));
    written.map_err(|error| {
        let _ = fs::remove_file(&temporary);
        named(path, "cannot be written", &error)
    })
}

/// Makes a folder, if it does not exist, and those around it.
///
/// # Errors
/// The system's, with the folder's name.
pub fn make_folder(path: &Path) -> io::Result<()> {
    fs::create_dir_all(path).map_err(|error| named(path, "cannot be made", &error))
}

/// Deletes a file. That there is none is no error.
///
/// # Errors
/// The system's, with the file's name.
pub fn remove(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => {
            Err(named(path, "cannot be deleted", &error))
        }
        _ => Ok(()),
    }
}

/// Checks that files can be written in a folder, or in the nearest one around it that exists. Nothing stays there.
///
/// # Errors
/// The system's, with that folder's name.
pub fn check_writable(folder: &Path) -> io::Result<()> {
    let exists = |path: &&Path| fs::symlink_metadata(path).is_ok();
    let existing = folder.ancestors().find(exists).unwrap_or(Path::new("."));
    let probe = existing.join(format!(".virtwall.{}.tmp", std::process::id()));
    let written = fs::write(&probe, "").and_then(|()| fs::remove_file(&probe));
    written.map_err(|error| named(existing, "cannot be written", &error))
}

/// An error that names its file or folder.
pub fn named(path: &Path, what: &str, error: &io::Error) -> io::Error {
    io::Error::new(error.kind(), format!("{}: {what}: {error}", path.display()))
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
