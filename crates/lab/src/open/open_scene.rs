//! A scene without an experiment, for statistics and pictures.

use config::Fault;

use crate::experiment::fields::Experiment;
use crate::files::find::{FileKind, find_here};
use crate::open::first_light::FirstLight;
use crate::open::scene::Scene;
use crate::open::settings::Settings;

/// A scene, and how its own description, if it has one, says to mesh it.
pub struct OpenScene {
    /// What it shows, if its description says so.
    pub title: Option<String>,
    /// Its file, for messages.
    pub label: String,
    /// The geometry.
    pub scene: radiosity::Scene,
    /// What was corrected on loading.
    pub warnings: Vec<String>,
    /// That it is dark, inside out, or in another unit.
    pub light_warnings: Vec<String>,
    /// Where the light of its lamps falls, if it has lamps.
    pub first_light: Option<FirstLight>,
    /// Longest edge of a patch, metres.
    pub patch_size: f64,
    /// Longest edge of a patch that emits light, metres.
    pub emitter_patch_size: f64,
    /// Cells along x, y and z.
    pub cells: [u32; 3],
}

impl OpenScene {
    /// Loads the scene that a name, or a path to a scene description or an OBJ file, means.
    pub fn load(name: &str) -> Result<OpenScene, Fault> {
        let found = find_here(&FileKind::SCENES, name).map_err(Fault::complete)?;
        let scene = Scene::load(&found)?;
        let whole = Experiment::of_one_environment(name);
        let settings = Settings::of(&whole, &scene)
            .map_err(|(_, message)| Fault::of_file(&found.label, message))?;
        Ok(OpenScene {
            title: scene.file.and_then(|file| file.title),
            label: found.label,
            scene: scene.geometry,
            warnings: scene.warnings,
            light_warnings: scene.light_warnings,
            first_light: scene.first_light,
            patch_size: settings.patch_size,
            emitter_patch_size: settings.emitter_patch_size,
            cells: settings.cells.0,
        })
    }

    /// All warnings.
    pub fn all_warnings(&self) -> impl Iterator<Item = &String> {
        self.warnings.iter().chain(&self.light_warnings)
    }

    /// The scene, if it has no participating media.
    ///
    /// # Errors
    /// If it has: what is asked for would leave them out.
    pub fn without_media(self) -> Result<OpenScene, Fault> {
        if self.scene.media.is_empty() {
            return Ok(self);
        }
        let message = "the scene has \"media\"; expected none, since this would leave them out";
        Err(Fault::of_file(&self.label, message.to_owned()))
    }
}
