//! A folder of results, claimed by one process at a time.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use crate::files::file::{self, named};
use crate::run::saved::FOLDER;

/// A folder of results that this process alone writes, until this is dropped or the process ends.
pub struct Claim {
    path: PathBuf,
    /// Holds the system's lock.
    _file: File,
}

impl Claim {
    /// Makes the folder and claims it by a lock in its folder of finished runs.
    ///
    /// # Errors
    /// If another process has claimed it, or it cannot be written.
    pub fn of(out: &Path) -> io::Result<Claim> {
        let folder = out.join(FOLDER);
        let path = folder.join("lock");
        loop {
            file::make_folder(&folder)?;
            // A process that ends meanwhile deletes its file, and the folder.
            let Some(file) = locked(out, &path)? else { continue };
            let owner = fs::read_to_string(&path).unwrap_or_default();
            if owner == std::process::id().to_string() {
                return Ok(Claim { path, _file: file });
            }
        }
    }
}

impl Drop for Claim {
    fn drop(&mut self) {
        // The lock ends with the process in any case.
        let _ = fs::remove_file(&self.path);
        let _ = self.path.parent().map(fs::remove_dir);
    }
}

/// The file of a lock, locked and with the number of this process in it; none if its folder has gone.
fn locked(out: &Path, path: &Path) -> io::Result<Option<File>> {
    let refuse = |error: io::Error| named(path, "cannot be written", &error);
    let mut options = OpenOptions::new();
    let mut file = match options.read(true).write(true).create(true).open(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        opened => opened.map_err(refuse)?,
    };
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => {
            let mut owner = String::new();
            let _ = file.read_to_string(&mut owner);
            let owner = if owner.is_empty() { owner } else { format!(" (process {owner})") };
            let (out, path) = (out.display(), path.display());
            let message = format!(
                "{out}: another run{owner} writes its results there and has locked {path}; expected no other"
            );
            return Err(io::Error::new(io::ErrorKind::ResourceBusy, message));
        }
        // Some network file systems have no locks.
        Err(TryLockError::Error(_)) | Ok(()) => {}
    }
    let id = std::process::id().to_string();
    file.set_len(0).and_then(|()| file.write_all(id.as_bytes())).map_err(refuse)?;
    Ok(Some(file))
}
