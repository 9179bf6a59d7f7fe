//! A scene: its geometry, with its description if it has one.

use std::cell::{Cell, RefCell};
use std::path::Path;
use std::{fs, io};

use config::{Document, Fault, Place, read_text};
use scenemaker::{FLOORS, SceneText, make_building};

use crate::files::digest::FileDigest;
use crate::files::find::Found;
use crate::open::scene_file::SceneFile;

pub struct Scene {
    /// Its description; none for a bare OBJ file.
    pub file: Option<SceneFile>,
    pub geometry: radiosity::Scene,
    /// What was corrected on loading.
    pub warnings: Vec<String>,
    pub digests: Vec<FileDigest>,
    /// Bytes of its geometry and materials.
    pub bytes: u64,
}

impl Scene {
    /// Loads a scene description and its geometry, or a bare OBJ file.
    pub fn load(found: &Found) -> Result<Scene, Fault> {
        let (path, label) = (&found.path, Path::new(&found.label));
        if path.extension().is_some_and(|ending| ending == "obj") {
            return Scene::of_obj(path, label, &|path| fs::read(path));
        }
        let text = read_text(path)?;
        let digest = FileDigest::of(text.as_bytes(), &found.label);
        let document = Document::parse(path.display(), text)?;
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
        let origin = scene.geometry.origin;
        scene.geometry.media = file.media.iter().map(|medium| medium.medium(origin)).collect();
        scene.digests.insert(0, digest);
        scene.file = Some(file);
        Ok(scene)
    }

    /// The scene of an OBJ file and its material files, whose bytes `reader` gives.
    fn of_obj(
        path: &Path,
        label: &Path,
        reader: &dyn Fn(&Path) -> io::Result<Vec<u8>>,
    ) -> Result<Scene, Fault> {
        let folder = path.parent().unwrap_or(Path::new(""));
        // Materials decide the light as much as the geometry does. Missing files give warnings.
        let (digests, bytes_read) = (RefCell::new(Vec::new()), Cell::new(0));
        let digesting = |path: &Path| {
            let bytes = reader(path)?;
            bytes_read.set(bytes_read.get() + bytes.len() as u64);
            let name = path.strip_prefix(folder).unwrap_or(path);
            let label = label.with_file_name(name).display().to_string();
            digests.borrow_mut().push(FileDigest::of(&bytes, &label));
            Ok(bytes)
        };
        let (geometry, warnings) =
            radiosity::load_obj_from(path, &digesting).map_err(Fault::complete)?;
        let label = label.display();
        let warnings = warnings.iter().map(|warning| format!("{label}: {warning}")).collect();
        let (digests, bytes) = (digests.into_inner(), bytes_read.get());
        Ok(Scene { file: None, geometry, warnings, digests, bytes })
    }
}

/// The scene that a description asks to generate, if it does.
fn made(document: &Document, file: &SceneFile) -> Result<Option<SceneText>, Fault> {
    let Some(made) = file.made else { return Ok(None) };
    let floors = made.building_floors;
    let text = make_building(floors, made.seed).ok_or_else(|| {
        let message = format!("{floors}; expected {} to {}", FLOORS.start(), FLOORS.end());
        document.fault(&Place::of("made").key("building_floors"), message)
    });
    text.map(Some)
}
