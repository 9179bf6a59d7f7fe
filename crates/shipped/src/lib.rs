//! Files that are part of the program, so that it works in any folder: scenes, machines, experiments with the
//! paper's tables, and reference solutions. Their paths begin with [`ROOT`], which is no folder of the host.

use std::path::{Component, Path, PathBuf};

use include_dir::{Dir, include_dir};

/// First part of the path of a built-in file.
pub const ROOT: &str = "<built-in>";

static FOLDERS: [(&str, Dir); 4] = [
    ("experiments", include_dir!("$CARGO_MANIFEST_DIR/../../experiments")),
    ("machines", include_dir!("$CARGO_MANIFEST_DIR/../../machines")),
    ("results/references", include_dir!("$CARGO_MANIFEST_DIR/../../results/references")),
    ("scenes", include_dir!("$CARGO_MANIFEST_DIR/../../scenes")),
];

/// The bytes of a built-in file; none if the path is not one of a built-in file.
pub fn file(path: &Path) -> Option<&'static [u8]> {
    let inside = plain(path.strip_prefix(ROOT).ok()?)?;
    FOLDERS.iter().find_map(|(folder, files)| {
        let file = files.get_file(inside.strip_prefix(folder).ok()?)?;
        Some(file.contents())
    })
}

/// Whether there is a built-in file or one of the host at this path.
pub fn is_file(path: &Path) -> bool {
    file(path).is_some() || path.is_file()
}

/// Paths of the JSON files in a built-in folder, sorted; none if the path is not one of a built-in folder.
pub fn json_files(folder: &Path) -> Vec<PathBuf> {
    let Some(inside) = folder.strip_prefix(ROOT).ok().and_then(plain) else { return Vec::new() };
    let dirs = FOLDERS.iter().filter_map(|(name, dir)| {
        let below = inside.strip_prefix(name).ok()?;
        if below == Path::new("") { Some(dir) } else { dir.get_dir(below) }
    });
    let names = dirs.flat_map(Dir::files).filter_map(|file| file.path().file_name());
    let paths = names.map(|name| folder.join(name));
    let mut paths: Vec<PathBuf> =
        paths.filter(|path| path.extension().is_some_and(|ending| ending == "json")).collect();
    paths.sort();
    paths
}

/// The path without `.` and `..`; none if it leaves its root.
fn plain(path: &Path) -> Option<PathBuf> {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir if plain.pop() => {}
            Component::Normal(name) => plain.push(name),
            _ => return None,
        }
    }
    Some(plain)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_found_by_their_paths() {
        let bytes = |path: &str| file(&Path::new(ROOT).join(path));
        let office = bytes("scenes/office.json").unwrap_or_default();
        assert!(office.starts_with(b"{"));
        assert_eq!(bytes("experiments/./../scenes/office.json"), Some(office));
        assert_eq!(bytes("../scenes/office.json"), None);
        assert_eq!(file(Path::new("scenes/office.json")), None);
        for name in ["machines/ultra1", "experiments/stability/sphere", "results/references/office"]
        {
            let path = Path::new(ROOT).join(format!("{name}.json"));
            assert!(json_files(path.parent().unwrap_or(&path)).contains(&path), "{name}");
        }
    }
}
