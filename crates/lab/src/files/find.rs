//! Finds scenes, machines, experiments and references by name, in folders of the user and among those that
//! are built in.

use config::unknown;
use std::path::{Path, PathBuf};

/// A kind of file that has a name.
pub struct FileKind {
    noun: &'static str,
    /// Its folder, beside that of the file that names it.
    folder: &'static str,
}

impl FileKind {
    /// Scene descriptions.
    pub const SCENES: FileKind = FileKind { noun: "scene", folder: "scenes" };
    /// Machine files.
    pub const MACHINES: FileKind = FileKind { noun: "machine", folder: "machines" };
    /// Experiments.
    pub const EXPERIMENTS: FileKind = FileKind { noun: "experiment", folder: "experiments" };
    /// Reference solutions.
    pub const REFERENCES: FileKind = FileKind { noun: "reference", folder: "results/references" };
}

/// A file that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// Where it is.
    pub path: PathBuf,
    /// What results call it, the same wherever the project lies: "scenes/office.json", or the
    /// path as the user wrote it.
    pub label: String,
}

/// A file at a path from the folder of the one that names it.
pub fn named_from(folder: &Path, name: &str) -> Result<PathBuf, String> {
    let path = folder.join(name);
    match missing(&path) {
        None => Ok(path),
        Some(missing) => Err(format!("\"{name}\": {missing}; expected a path from this file")),
    }
}

/// What is said of a path without a file: that nothing is there, or something that is no regular file.
pub fn missing(path: &Path) -> Option<&'static str> {
    match path.exists() {
        _ if shipped::is_file(path) => None,
        true => Some("not a regular file"),
        false => Some("no such file"),
    }
}

/// Whether the name of a file says that it is a JSON file.
pub fn is_json(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("json"))
}

/// Finds what the name or path `name` in a file in `folder` means. A name is looked up in
/// the folder of that kind beside the file's folder, then in the current folder, then among the
/// built-in files; a path (with a slash or an ending) is relative to `folder`, else to the current
/// folder. What no folder has as a name is a path if there is such a file.
///
/// # Errors
/// If there is no such file: a message that lists the names there are.
pub fn find(folder: &Path, kind: &FileKind, name: &str) -> Result<Found, String> {
    let beside = beside(folder).join(kind.folder);
    let mut folders = vec![beside, PathBuf::from(kind.folder)];
    // Of a built-in file too, the user's files are found first.
    folders.retain(|folder| !folder.starts_with(shipped::ROOT));
    find_in(&folders, folder, kind, name)
}

/// The same for a name or path on the command line.
///
/// # Errors
/// If there is no such file.
pub fn find_here(kind: &FileKind, name: &str) -> Result<Found, String> {
    find_in(&[PathBuf::from(kind.folder)], Path::new(""), kind, name)
}

/// All files of a kind that have names here, by name.
pub fn all_here(kind: &FileKind) -> Vec<Found> {
    let folders = [PathBuf::from(kind.folder), Path::new(shipped::ROOT).join(kind.folder)];
    let mut known: Vec<String> = folders.iter().flat_map(|folder| names(folder)).collect();
    known.sort();
    known.dedup();
    known.iter().filter_map(|name| find_here(kind, name).ok()).collect()
}

fn find_in(
    folders: &[PathBuf],
    folder: &Path,
    kind: &FileKind,
    name: &str,
) -> Result<Found, String> {
    let paths = [folder.join(name), PathBuf::from(name)];
    let at_path = || {
        let path = paths.iter().find(|path| shipped::is_file(path))?.clone();
        Some(Found { path, label: name.to_owned() })
    };
    let ending = Path::new(name).extension().unwrap_or_default();
    if name.contains(['/', '\\']) || ["json", "obj"].iter().any(|e| ending.eq_ignore_ascii_case(e))
    {
        return at_path().ok_or_else(|| {
            let from = if folder == Path::new("") { Path::new(".") } else { folder };
            let missing = missing(paths.iter().find(|path| path.exists()).unwrap_or(&paths[0]));
            let missing = missing.unwrap_or_default();
            format!("\"{name}\": {missing}; expected a path from {}", from.display())
        });
    }
    let built_in = Path::new(shipped::ROOT).join(kind.folder);
    let all = || folders.iter().chain([&built_in]);
    let file = format!("{name}.json");
    if !name.is_empty()
        && let Some(path) = all().map(|s| s.join(&file)).find(|path| shipped::is_file(path))
    {
        return Ok(Found { path, label: format!("{}/{file}", kind.folder) });
    }
    if let Some(found) = at_path() {
        return Ok(found);
    }
    let of_kind = all().map(|folder| folder.join(&file));
    if let Some(path) = of_kind.chain(paths.clone()).find(|path| path.exists() && !path.is_dir()) {
        return Err(format!("{}: not a regular file", path.display()));
    }
    let mut known: Vec<String> = all().flat_map(|folder| names(folder)).collect();
    known.sort();
    known.dedup();
    Err(unknown(kind.noun, name, &known))
}

fn beside(folder: &Path) -> PathBuf {
    match (folder.file_name(), folder.parent()) {
        (Some(_), Some(parent)) => parent.to_owned(),
        _ => folder.join(".."),
    }
}

/// Names of the JSON files in a folder.
fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    entries
        .map(|entry| entry.path())
        .chain(shipped::json_files(folder))
        .filter(|path| path.extension().is_some_and(|ending| ending == "json"))
        .filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned()))
        .collect()
}
