//! A scene with light to draw: its own solution, or the light of a run at any instant.

use std::path::Path;
use std::sync::Arc;

use config::{Document, Fault};
use desim::Time;
use multicomputer::Machine;
use radiosity::{LocalEnvironment, Space};
use serde_json::Value;
use virtwall::{KeptShots, Problem};

use crate::engine::simulator::{self, Light, Solved};
use crate::experiment::accuracy;
use crate::experiment::fields::Experiment;
use crate::files::digest::FileDigest;
use crate::files::find::{FileKind, find_here, is_json};
use crate::open::problem;
use crate::open::scene::Scene;
use crate::open::settings::Settings;
use crate::planning::plan::Plan;
use crate::results::origin::origin;

/// A scene, and where its light comes from.
pub struct Stage {
    /// Title of the picture or file.
    pub title: String,
    /// The run that lights it; none if the scene is solved without a run.
    pub run: Option<StagedRun>,
    /// What was corrected in its scene, and what is odd.
    pub warnings: Vec<String>,
    problem: Arc<Problem>,
}

/// A run that can be looked at repeatedly: it is simulated again each time, with kept shots.
pub struct StagedRun {
    /// Its row in the results, from 1.
    pub row: usize,
    point: Experiment,
    machine: Machine,
    kept: Arc<KeptShots>,
}

/// Rays a shot where the scene is solved without a run.
const PIXELS: u32 = 4_096;

/// Which run of an experiment.
pub struct Which<'a> {
    /// `path=value` arguments that change the experiment.
    pub set: &'a [String],
    /// Its row in the results, from 1; the last one by default.
    pub row: Option<usize>,
}

impl Stage {
    /// The scene that a name or a path means; or a run of the experiment that a path means, or of the
    /// one whose results are in a folder.
    pub fn open(what: &str, which: &Which) -> Result<Stage, Fault> {
        let path = Path::new(what);
        if path.is_dir() {
            return Stage::of_results(path, which);
        }
        if is_json(path) && path.is_file() {
            let document = Document::read(path)?;
            if document.value.get("scene").is_some() {
                return Stage::of_run(path, document, which, &Value::Null);
            }
        }
        Stage::of_scene(what)
    }

    fn of_scene(name: &str) -> Result<Stage, Fault> {
        let found = find_here(&FileKind::SCENES, name).map_err(Fault::complete)?;
        let scene = Scene::load(&found)?;
        let fault = |(_, message)| Fault::of_file(&found.label, message);
        let mut whole = Experiment::of_one_environment(name);
        whole.hemisphere.pixels = PIXELS;
        let settings = Settings::of(&whole, &scene).map_err(fault)?;
        let problem = problem::problem(&scene.geometry, &settings).map_err(fault)?;
        let warnings = scene.all_warnings().cloned().collect();
        let title = scene.file.and_then(|file| file.title).unwrap_or(found.label);
        Ok(Stage { title, run: None, warnings, problem })
    }

    /// The run is simulated again from the experiment in the manifest.
    fn of_results(folder: &Path, which: &Which) -> Result<Stage, Fault> {
        let path = folder.join("manifest.json");
        let mut document = Document::read(&path)?;
        let experiment = document.value.get_mut("experiment").map(Value::take);
        let Some(experiment) = experiment.filter(Value::is_object) else {
            let message = "no \"experiment\"; expected a manifest that `run` wrote";
            return Err(Fault::of_file(path.display(), message));
        };
        let files = std::mem::replace(&mut document.value, experiment)["files"].take();
        accuracy::without_replaced(&mut document.value);
        // Paths in an experiment start from its file.
        let experiment = origin(folder).unwrap_or_else(|| path.clone());
        Stage::of_run(&experiment, document, which, &files)
    }

    /// A run of an experiment; `files` are the digests that its results have of what they were made from.
    fn of_run(
        path: &Path,
        document: Document,
        which: &Which,
        files: &Value,
    ) -> Result<Stage, Fault> {
        let file = document.file.clone();
        let (plan, row) = Plan::of_row(path, document, which.set, which.row)?;
        let changed = |file: &&FileDigest| {
            files[&file.label].as_str().is_some_and(|digest| digest != file.sha256)
        };
        if let Some(changed) = plan.files.iter().find(changed) {
            return Err(Fault::of_file(file, not_the_same(changed, files)));
        }
        let run = &plan.runs[0];
        let point = run.point.clone();
        let title = format!("{}, {} on {} processors", plan.title, point.scene, point.processors);
        let problem = Arc::clone(&plan.problems[run.problem].problem);
        let machine = plan.machines[run.machine].machine.clone();
        let kept = Arc::new(KeptShots::new(crate::host::host_memory::half_of_free_memory()));
        let run = StagedRun { row, point, machine, kept };
        let warnings = plan.warnings.clone();
        Ok(Stage { title, run: Some(run), warnings, problem })
    }

    /// The scene in its grid.
    pub fn space(&self) -> &Space {
        &self.problem.space
    }

    /// Its environments, by number.
    pub fn environments(&self) -> &[LocalEnvironment] {
        &self.problem.environments
    }

    /// The light when at most the share `unshot` of it is unshot, or after many shots. Calls `watch` after
    /// each shot with the share that is left. The run's, if there is one, has no part in it.
    pub fn solved(&self, unshot: f64, watch: impl FnMut(f64)) -> Solved {
        simulator::solved(&self.problem, unshot, watch)
    }

    /// The light of the run at each of these times, in rising order; after its end there is no other.
    /// And when it ends. Calls `on_shot` after each shot.
    ///
    /// # Errors
    /// Why the run did not end, or that there is none.
    pub fn light_at(
        &self,
        times: &[Time],
        on_shot: impl Fn() + Send + Sync + 'static,
    ) -> Result<(Vec<Light>, Time), String> {
        let Some(staged) = &self.run else { return Err("no run lights it".to_owned()) };
        let on_shot = Arc::new(move |_: &_| on_shot());
        let run = simulator::run(&self.problem, &staged.point, &staged.kept, on_shot);
        simulator::light_at(&run, &staged.point, &staged.machine, times)
    }
}

fn not_the_same(found: &FileDigest, files: &Value) -> String {
    let FileDigest { label, sha256 } = found;
    format!(
        "the results were made from another {label}, SHA-256 {}; found {sha256}. Expected the file as it was; \
         to draw it as it is, name the experiment instead of its results",
        files[label].as_str().unwrap_or_default()
    )
}
