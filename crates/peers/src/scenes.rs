//! The scenes that rays are cast through.

use std::path::PathBuf;

use tempfile::TempDir;

/// A scene to measure.
pub struct Bench {
    /// What it is called in tables.
    pub name: String,
    /// Its name among the project's scenes, or its file.
    pub path: PathBuf,
}

/// The rooms with so many tables in each: about a thousand polygons and about ten thousand.
const ROOMS: [(&str, u32); 2] = [("S", 0), ("M", 30)];

/// The scenes asked for, or the rooms with few and with many polygons and the paper's three.
///
/// # Errors
/// When a scene cannot be written into `folder`.
pub fn scenes(asked: &[PathBuf], folder: &TempDir) -> Result<Vec<Bench>, String> {
    if !asked.is_empty() {
        let named = |path: &PathBuf| Bench { name: path.display().to_string(), path: path.clone() };
        return Ok(asked.iter().map(named).collect());
    }
    let mut scenes = Vec::new();
    for (name, tables) in ROOMS {
        let text = scenemaker::make_rooms(tables, 1996);
        let folder = folder.path().join(name);
        let path = folder.join("rooms.obj");
        std::fs::create_dir(&folder)
            .and_then(|()| std::fs::write(&path, text.obj))
            .and_then(|()| std::fs::write(folder.join("rooms.mtl"), text.mtl))
            .map_err(|error| format!("{}: {error}", path.display()))?;
        let name = format!("{name}: rooms, {tables} tables each");
        scenes.push(Bench { name, path });
    }
    for name in ["rooms", "building", "office"] {
        scenes.push(Bench { name: name.to_owned(), path: PathBuf::from(name) });
    }
    Ok(scenes)
}
