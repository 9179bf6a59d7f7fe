//! Files and folders that commands write. What cannot be written is bad input.

use std::path::Path;

use crate::exit::Exit;

/// Makes a folder, if it does not exist; `purpose` is what it is for.
pub fn make_folder(path: &Path, purpose: &str) -> Result<(), Exit> {
    std::fs::create_dir_all(path).map_err(|error| {
        Exit::bad_input(format!("{}: cannot make a folder for {purpose}: {error}", path.display()))
    })
}

/// Checks that a file can be written: before the work whose result it is to hold.
pub fn check_writable(path: &Path) -> Result<(), Exit> {
    let path = &lab::target(path).map_err(Exit::bad_input)?;
    let folder = path.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."));
    if !folder.is_dir() {
        let message = format!("{}: cannot be written: its folder does not exist", path.display());
        return Err(Exit::bad_input(message));
    }
    lab::check_writable(folder).map_err(Exit::bad_input)
}

pub fn write(path: &Path, bytes: impl AsRef<[u8]>) -> Result<(), Exit> {
    lab::write_file(path, bytes.as_ref()).map_err(Exit::bad_input)
}
