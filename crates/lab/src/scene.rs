//! A scene: its geometry, with its description if it has one.

use std::path::Path;
use std::{fs, io};

use scenemaker::{FLOORS, SceneText, make_building};

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
    /// Loads a scene description and its geometry, or a bare OBJ file.
    ///
    /// # Errors
    /// What is wrong with them, and where.
    pub fn load(found: &Found) -> Result<Scene, Fault> {
        let (path, label) = (&found.path, Path::new(&found.label));
        if path.extension().is_some_and(|ending| ending == "obj") {
            return Scene::of_obj(path, label, &|path| fs::read(path));
        }
        let document = Document::read(path)?;
        let file = SceneFile::of(&document)?;
        let mut scene = match made(&document, &file)? {
            Some(text) => {
                let obj = format!("{}.obj", text.name);
                let made = |path: &Path| match path.extension().and_then(|e| e.to_str()) {
                    Some("obj") => Ok(text.obj.clone().into_bytes()),
                    _ => Ok(text.mtl.clone().into_bytes()),
                };
                Scene::of_obj(&path.with_file_name(&obj), &label.with_file_name(&obj), &made)?
            }
            None => {
                let name = file.obj.as_deref().unwrap_or_default();
                let folder = path.parent().unwrap_or(Path::new(""));
                let obj = folder.join(name);
                if !obj.is_file() {
                    let message = format!("\"{name}\": no such file in {}", folder.display());
                    return Err(document.fault(&Place::of("obj"), message));
                }
                Scene::of_obj(&obj, &label.with_file_name(name), &|path| fs::read(path))?
            }
        };
        scene.digests.insert(0, FileDigest::of(path, &found.label)?);
        scene.file = Some(file);
        Ok(scene)
    }

    /// The scene of an OBJ file and its material files, whose bytes `reader` gives.
    fn of_obj(
        path: &Path,
        label: &Path,
        reader: &dyn Fn(&Path) -> io::Result<Vec<u8>>,
    ) -> Result<Scene, Fault> {
        let (geometry, warnings) =
            radiosity::load_obj_from(path, reader).map_err(Fault::complete)?;
        let label_text = label.display().to_string();
        let warnings = warnings.iter().map(|warning| format!("{label_text}: {warning}")).collect();
        let obj = reader(path).map_err(|error| file::unreadable(path, error))?;
        let mut digests = vec![FileDigest::of_bytes(&obj, &label_text)];
        // Materials decide the light as much as the geometry does. What is missing was warned of.
        for library in material_libraries(&obj) {
            if let Ok(bytes) = reader(&path.with_file_name(&library)) {
                let label = label.with_file_name(&library).display().to_string();
                digests.push(FileDigest::of_bytes(&bytes, &label));
            }
        }
        Ok(Scene { file: None, geometry, warnings, digests })
    }
}

/// The scene that a description says to make, if it does.
fn made(document: &Document, file: &SceneFile) -> Result<Option<SceneText>, Fault> {
    let Some(made) = file.made else { return Ok(None) };
    let floors = made.building_floors;
    let text = make_building(floors, made.seed).ok_or_else(|| {
        let message = format!("{floors}; expected {} to {}", FLOORS.start(), FLOORS.end());
        document.fault(&Place::of("made").key("building_floors"), message)
    });
    text.map(Some)
}

/// The material files that an OBJ file names.
fn material_libraries(obj: &[u8]) -> Vec<String> {
    let text = String::from_utf8_lossy(obj);
    let names = text.lines().filter_map(|line| line.trim().strip_prefix("mtllib "));
    names.map(|name| name.trim().to_owned()).collect()
}
