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
    let folder = path.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."));
    let refused =
        |why| Err(Exit::bad_input(format!("{}: cannot be written: {why}", path.display())));
    match () {
        () if path.is_dir() => refused("it is a folder"),
        () if !folder.is_dir() => refused("its folder does not exist"),
        () => lab::check_writable(folder).map_err(Exit::bad_input),
    }
}

pub fn write(path: &Path, bytes: impl AsRef<[u8]>) -> Result<(), Exit> {
    lab::write_file(path, bytes.as_ref()).map_err(Exit::bad_input)
}
