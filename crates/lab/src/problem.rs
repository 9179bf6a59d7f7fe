//! A scene, meshed and cut: what runs on different machines and by different rules share.

use std::path::Path;

use serde::Serialize;

use crate::cut::{automatic_cells, automatic_cut};
use crate::digest::FileDigest;
use crate::document::Document;
use crate::engine;
use crate::experiment::{Directions, Experiment};
use crate::fault::Fault;
use crate::find::Found;
use crate::quantity::Triple;
use crate::scene_file::SceneFile;

/// A patch of a bare OBJ file is at most this share of the scene's diagonal long.
const BARE_PATCHES: f64 = 1.0 / 50.0;

/// More patches than a host's memory holds with ease.
const MOST_PATCHES: f64 = 2e7;

/// A scene with its description, if it has one.
pub struct Scene {
    /// Its description; none for a bare OBJ file.
    pub file: Option<SceneFile>,
    /// Its geometry.
    pub geometry: engine::Scene,
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
            return Err(document.fault(&crate::place::Place::of("obj"), message));
        }
        Scene::of_obj(&obj, &label.with_file_name(&file.obj), Some(file), digests)
    }

    fn of_obj(
        path: &Path,
        label: &Path,
        file: Option<SceneFile>,
        mut digests: Vec<FileDigest>,
    ) -> Result<Scene, Fault> {
        let geometry = engine::Scene::load(path, &label.display().to_string())?;
        digests.push(FileDigest::of(path, &label.display().to_string())?);
        // Materials decide the light as much as the geometry does.
        for library in material_libraries(path) {
            let (path, label) = (path.with_file_name(&library), label.with_file_name(&library));
            if path.is_file() {
                digests.push(FileDigest::of(&path, &label.display().to_string())?);
            }
        }
        Ok(Scene { file, geometry, digests })
    }
}

/// The material files that an OBJ file names.
fn material_libraries(obj: &Path) -> Vec<String> {
    let text = std::fs::read(obj).unwrap_or_default();
    let text = String::from_utf8_lossy(&text);
    let names = text.lines().filter_map(|line| line.trim().strip_prefix("mtllib "));
    names.map(|name| name.trim().to_owned()).collect()
}

/// How a scene is meshed, cut and lit: all that decides what a shot does.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Settings {
    /// The scene, as the experiment names it.
    pub scene: String,
    /// Local environments along x, y and z.
    pub cut: Triple,
    /// Cells along x, y and z.
    pub cells: Triple,
    /// Longest edge of a patch, metres.
    #[serde(rename = "patch_size_m")]
    pub patch_size: f64,
    /// Longest edge of a patch that emits light, metres.
    #[serde(rename = "emitter_patch_size_m")]
    pub emitter_patch_size: f64,
    /// How rays are spread over the hemisphere.
    pub directions: Directions,
    /// Rays a source.
    pub pixels: u32,
    /// Whether each source turns them.
    pub rotated: bool,
}

impl Settings {
    /// The experiment's own settings, else the scene file's, else automatic ones.
    ///
    /// # Errors
    /// The field at fault, and what is wrong.
    pub fn of(point: &Experiment, scene: &Scene) -> Result<Settings, (&'static str, String)> {
        let (cells, cut) = cells_and_cut(point, scene)?;
        let file = scene.file.as_ref();
        let extents = scene.geometry.extents();
        let diagonal = extents.iter().map(|extent| extent * extent).sum::<f64>().sqrt();
        let own = point.patch_size.as_ref().or(file.map(|file| &file.patch_size));
        let patch_size = own.map_or(diagonal * BARE_PATCHES, |size| size.value());
        let of_file = file.and_then(|file| file.emitter_patch_size.as_ref());
        let emitters = point.emitter_patch_size.as_ref().or(of_file);
        let patches = scene.geometry.area() / (patch_size * patch_size);
        if patches > MOST_PATCHES {
            let message = format!("{patch_size} m makes some {patches:.0} patches");
            return Err(("patch_size", format!("{message}; expected at most {MOST_PATCHES}")));
        }
        Ok(Settings {
            scene: point.scene.clone(),
            cut,
            cells,
            patch_size,
            emitter_patch_size: emitters.map_or(patch_size, |size| size.value()),
            directions: point.hemisphere.directions,
            pixels: point.hemisphere.pixels,
            rotated: point.hemisphere.rotated,
        })
    }
}

fn cells_and_cut(
    point: &Experiment,
    scene: &Scene,
) -> Result<(Triple, Triple), (&'static str, String)> {
    let (file, extents) = (scene.file.as_ref(), scene.geometry.extents());
    let environments = point.local_environments;
    if let Some(cut) = point.cut.filter(|cut| cut.product() != u64::from(environments)) {
        let message = format!("\"{cut}\" makes {} local environments", cut.product());
        return Err(("cut", format!("{message}; expected {environments}")));
    }
    let chosen = point.cut.or(file.and_then(|file| file.cut(environments)));
    let fixed = point.cells.or(file.and_then(|file| file.cells));
    let Some(cut) = chosen.or_else(|| automatic_cut(extents, environments, fixed)) else {
        let cells = fixed.map_or(String::new(), |cells| format!(" of {cells}"));
        let message = format!("{environments} boxes do not fit the grid of cells{cells}");
        return Err(("local_environments", message + "; expected a cell or more in each"));
    };
    let polygons = scene.geometry.polygons();
    let cells = fixed.unwrap_or_else(|| automatic_cells(extents, polygons, Some(cut)));
    if (0..3).any(|axis| cut.0[axis] > cells.0[axis]) {
        let message = format!("\"{cut}\" leaves local environments without a cell of {cells}");
        return Err(("cut", message + "; expected at most as many as cells along each axis"));
    }
    Ok((cells, cut))
}
