//! Which experiment file results were made from. A file of its own says it, for results are the same wherever
//! that file lies.

use std::io;
use std::path::{Component, Path, PathBuf};

use config::Document;
use serde_json::json;

use crate::files::file;

pub const FILE: &str = "origin.json";

/// Writes into a folder of results where the experiment file is: from the folder on if both are in one
/// tree, so that the tree can be moved.
pub fn write_origin(out: &Path, experiment: &Path) -> io::Result<()> {
    file::make_folder(out)?;
    let path = match experiment.starts_with(shipped::ROOT) {
        true => experiment.to_owned(),
        false => path_from(&out.canonicalize()?, &experiment.canonicalize()?),
    };
    let origin = json!({ "experiment": path.to_string_lossy().replace('\\', "/") });
    file::write(&out.join(FILE), format!("{origin}\n").as_bytes())
}

/// The experiment file that the results in a folder were made from, if the folder says it.
pub fn origin(folder: &Path) -> Option<PathBuf> {
    let document = Document::read(&folder.join(FILE)).ok()?;
    let path = Path::new(document.value["experiment"].as_str()?);
    Some(if path.starts_with(shipped::ROOT) { path.to_owned() } else { folder.join(path) })
}

/// The way from a folder to a file; both are absolute. Absolute if they share only the root.
fn path_from(folder: &Path, file: &Path) -> PathBuf {
    let shared = folder.components().zip(file.components()).take_while(|(a, b)| a == b).count();
    if !folder.components().take(shared).any(|part| matches!(part, Component::Normal(_))) {
        return file.to_owned();
    }
    let up = folder.components().skip(shared).map(|_| Component::ParentDir);
    up.chain(file.components().skip(shared)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_way_is_relative_within_one_tree() {
        for (folder, file, path) in [
            ("/a/results/x", "/a/experiments/x.json", "../../experiments/x.json"),
            ("/a", "/a/x.json", "x.json"),
            ("/a/b/c", "/a/x.json", "../../x.json"),
            ("/a", "/b/x.json", "/b/x.json"),
        ] {
            assert_eq!(path_from(Path::new(folder), Path::new(file)), Path::new(path));
        }
    }
}
