//! The scenes of the ray benchmark.

use std::path::PathBuf;

use tempfile::TempDir;

/// A scene of the benchmark.
pub struct BenchScene {
    /// Its name in tables.
    pub name: String,
    /// Its name in the folder of scenes, or its file.
    pub path: PathBuf,
}

/// Names, and numbers of tables in each room: about a thousand and about ten thousand polygons.
const ROOMS: [(&str, u32); 2] = [("S", 0), ("M", 30)];

/// The scenes that the user names; by default rooms of two sizes and the three scenes of the paper.
pub fn scenes(asked: &[PathBuf], folder: &TempDir) -> Result<Vec<BenchScene>, String> {
    if !asked.is_empty() {
        let named =
            |path: &PathBuf| BenchScene { name: path.display().to_string(), path: path.clone() };
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
        scenes.push(BenchScene { name, path });
    }
    for name in ["rooms", "building", "office"] {
        scenes.push(BenchScene { name: name.to_owned(), path: PathBuf::from(name) });
    }
    Ok(scenes)
}
