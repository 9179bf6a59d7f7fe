//! A scene: its geometry, with its description if it has one.

use std::path::Path;

use crate::digest::FileDigest;
use crate::document::Document;
use crate::fault::Fault;
use crate::file;
use crate::find::Found;
use crate::place::Place;
use crate::scene_file::SceneFile;

/// A scene with its description, if it has one.
pub struct Scene {
    /// Its description; none for a bare OBJ file.
    pub file: Option<SceneFile>,
    /// Its geometry.
    pub geometry: radiosity::Scene,
    /// What was mended on loading.
    pub warnings: Vec<String>,
    /// The files it was read from.
    pub digests: Vec<FileDigest>,
}

impl Scene {
    /// Loads a scene description and its OBJ file, or a bare OBJ file.
    ///
    /// # Errors
    /// What is wrong with them, and where.
    pub fn load(found: &Found) -> Result<Scene, Fault> {
        let (path, label) = (&found.path, Path::new(&found.label));
        if path.extension().is_some_and(|ending| ending == "obj") {
            return Scene::of_obj(path, label, None, Vec::new());
        }
        let document = Document::read(path)?;
        let file = SceneFile::of(&document)?;
        let digests = vec![FileDigest::of(path, &found.label)?];
        let folder = path.parent().unwrap_or(Path::new(""));
        let obj = folder.join(&file.obj);
        if !obj.is_file() {
            let message = format!("\"{}\": no such file in {}", file.obj, folder.display());
            return Err(document.fault(&Place::of("obj"), message));
        }
        Scene::of_obj(&obj, &label.with_file_name(&file.obj), Some(file), digests)
    }

    fn of_obj(
        path: &Path,
        label: &Path,
        file: Option<SceneFile>,
        mut digests: Vec<FileDigest>,
    ) -> Result<Scene, Fault> {
        let (geometry, warnings) = radiosity::load_obj(path).map_err(Fault::complete)?;
        let label_text = label.display().to_string();
        let warnings = warnings.iter().map(|warning| format!("{label_text}: {warning}")).collect();
        digests.push(FileDigest::of(path, &label_text)?);
        // Materials decide the light as much as the geometry does.
        for library in material_libraries(path)? {
            let (path, label) = (path.with_file_name(&library), label.with_file_name(&library));
            if path.is_file() {
                digests.push(FileDigest::of(&path, &label.display().to_string())?);
            }
        }
        Ok(Scene { file, geometry, warnings, digests })
    }
}

/// The material files that an OBJ file names.
fn material_libraries(obj: &Path) -> Result<Vec<String>, Fault> {
    let text = file::read(obj)?;
    let text = String::from_utf8_lossy(&text);
    let names = text.lines().filter_map(|line| line.trim().strip_prefix("mtllib "));
    Ok(names.map(|name| name.trim().to_owned()).collect())
}
