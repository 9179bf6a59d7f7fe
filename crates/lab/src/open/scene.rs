//! A scene: its geometry, with its description if it has one.

use std::cell::{Cell, RefCell};
use std::io;
use std::path::{Path, PathBuf};

use config::{Document, Fault, Place, read_text};
use radiosity::{ObjFile, read_regular_file};
use scenemaker::{FLOORS, SceneText, make_building};

use crate::files::digest::FileDigest;
use crate::files::find::{Found, missing};
use crate::open::first_light::FirstLight;
use crate::open::lighting::{self, bright_ambients};
use crate::open::scene_file::SceneFile;
use crate::open::surface::{change_materials, change_objects};

pub struct Scene {
    /// Its description; none for a bare OBJ file.
    pub file: Option<SceneFile>,
    pub geometry: radiosity::Scene,
    /// What was corrected on loading.
    pub warnings: Vec<String>,
    /// That it is dark, inside out, or in another unit.
    pub light_warnings: Vec<String>,
    /// Where the light of its lamps falls, if it has lamps.
    pub first_light: Option<FirstLight>,
    pub digests: Vec<FileDigest>,
    /// Bytes of its geometry and materials.
    pub bytes: u64,
}

impl Scene {
    /// All warnings.
    pub fn all_warnings(&self) -> impl Iterator<Item = &String> {
        self.warnings.iter().chain(&self.light_warnings)
    }

    /// Loads a scene description and its geometry, or a bare OBJ file.
    pub fn load(found: &Found) -> Result<Scene, Fault> {
        let (read, file) = read(found, &read_file)?;
        read.scene(file)
    }
}

/// Reads the files of a scene through `reader`, and changes them as its description says.
pub fn read(found: &Found, reader: Reader) -> Result<(Read, Option<SceneFile>), Fault> {
    let (path, label) = (&found.path, Path::new(&found.label));
    if is_obj(path) {
        return Ok((Read::of(path, label, reader)?, None));
    }
    let text = read_text(path)?;
    let digest = FileDigest::of(text.as_bytes(), &found.label);
    let document = Document::parse(path.display(), text)?;
    let file = SceneFile::of(&document)?;
    let mut read = match made(&document, &file)? {
        Some(text) => {
            let obj = format!("{}.obj", text.name);
            let made = |path: &Path| match is_obj(path) {
                true => Ok(text.obj.clone().into_bytes()),
                false => Ok(text.mtl.clone().into_bytes()),
            };
            Read::of(&path.with_file_name(&obj), &label.with_file_name(&obj), &made)?
        }
        None => {
            let name = file.obj.as_deref().unwrap_or_default();
            let folder = path.parent().unwrap_or(Path::new(""));
            let obj = folder.join(name);
            if let Some(missing) = missing(&obj) {
                let message = format!("\"{name}\": {missing} in {}", folder.display());
                return Err(document.fault(&Place::of("obj"), message));
            }
            Read::of(&obj, &label.with_file_name(name), reader)?
        }
    };
    let unknown = |field| {
        let document = &document;
        move |(name, message): (String, String)| {
            document.fault(&Place::of(field).key(&name), message)
        }
    };
    read.obj.scale(file.unit.metres());
    change_materials(&mut read.obj, &file.materials).map_err(unknown("materials"))?;
    change_objects(&mut read.obj, &file.objects).map_err(unknown("objects"))?;
    if file.two_sided {
        read.obj.default_to_two_sided();
    }
    read.digests.insert(0, digest);
    Ok((read, Some(file)))
}

/// A function that reads the bytes of a file.
type Reader<'a> = &'a dyn Fn(&Path) -> io::Result<Vec<u8>>;

/// Reads a built-in file or one of the host.
pub fn read_file(path: &Path) -> io::Result<Vec<u8>> {
    shipped::file(path).map_or_else(|| read_regular_file(path), |bytes| Ok(bytes.to_vec()))
}

/// Whether the name of a file says that it is an OBJ file.
pub fn is_obj(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("obj"))
}

/// An OBJ file with its material files, and what was read for them.
pub struct Read {
    pub obj: ObjFile,
    /// The OBJ file.
    pub path: PathBuf,
    /// Its material files.
    pub others: Vec<PathBuf>,
    /// What results call the OBJ file.
    label: String,
    digests: Vec<FileDigest>,
    bytes: u64,
}

impl Read {
    /// Reads files through `reader`.
    fn of(path: &Path, label: &Path, reader: Reader) -> Result<Read, Fault> {
        let folder = path.parent().unwrap_or(Path::new(""));
        // Materials decide the light as much as the geometry does. Missing files give warnings.
        let (digests, bytes_read) = (RefCell::new(Vec::new()), Cell::new(0));
        let others = RefCell::new(Vec::new());
        let digesting = |file: &Path| {
            let bytes = reader(file)?;
            if file != path {
                others.borrow_mut().push(file.to_owned());
            }
            bytes_read.set(bytes_read.get() + bytes.len() as u64);
            let name = file.strip_prefix(folder).unwrap_or(file);
            let label = label.with_file_name(name).display().to_string();
            digests.borrow_mut().push(FileDigest::of(&bytes, &label));
            Ok(bytes)
        };
        let obj = ObjFile::read(path, &digesting).map_err(Fault::complete)?;
        let label = label.display().to_string();
        let (path, others, digests) = (path.to_owned(), others.into_inner(), digests.into_inner());
        Ok(Read { obj, path, others, label, digests, bytes: bytes_read.get() })
    }

    /// The scene, with its description if it has one.
    pub fn scene(self, file: Option<SceneFile>) -> Result<Scene, Fault> {
        let Read { mut obj, label, digests, bytes, .. } = self;
        let clamp = file.as_ref().and_then(|file| file.clamp_reflectance);
        clamp.iter().for_each(|&most| obj.clamp_reflectances(most));
        let bright_ambients = bright_ambients(&obj);
        let (mut geometry, warnings) = obj.scene().map_err(Fault::complete)?;
        let origin = geometry.origin;
        if let Some(file) = &file {
            geometry.up = file.up.direction();
            geometry.media = file.media.iter().map(|medium| medium.medium(origin)).collect();
        }
        let say = |warning: String| format!("{label}: {warning}");
        let first_light = FirstLight::of(&geometry);
        let of_light = lighting::warnings(&geometry, first_light.as_ref(), &bright_ambients);
        let light_warnings = of_light.into_iter().map(say).collect();
        let warnings = warnings.iter().map(|warning| say(warning.to_string())).collect();
        Ok(Scene { file, geometry, warnings, light_warnings, first_light, digests, bytes })
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
