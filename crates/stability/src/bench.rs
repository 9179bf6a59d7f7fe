//! A case made ready: its runs, on its scene and on that changed.

use std::cell::OnceCell;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use lab::{Document, Fault, Trials};
use serde_json::Value;
use virtwall::{Outcome, Problem};

use crate::case::{Case, Overlay};
use crate::change::Change;

/// A case's runs. The light of each is found when it is asked for.
pub struct Bench<'a> {
    /// The case.
    pub case: &'a Case,
    /// What was mended in its scenes.
    pub warnings: Vec<String>,
    /// Each run on the scene as it is, then on each changed one.
    pub trials: Vec<Trial>,
    runs: Trials,
    /// The scene's own file, if it names one.
    pub scene_file: PathBuf,
}

/// A run on a scene.
pub struct Trial {
    /// Its swept fields and its change, in words.
    pub label: String,
    /// The change; none if the scene is as it was.
    pub change: Change,
    /// The scene, meshed and cut.
    pub problem: Arc<Problem>,
    run: usize,
    outcome: OnceCell<Result<Outcome, String>>,
}

impl<'a> Bench<'a> {
    /// The case with fields of its experiment replaced; `path` is the case's file.
    ///
    /// # Errors
    /// Why the experiment is refused.
    pub fn new(
        case: &'a Case,
        document: &Document,
        path: &Path,
        overlay: &Overlay,
    ) -> Result<Bench<'a>, Fault> {
        let mut experiment = document.clone();
        experiment.value = case.experiment.clone();
        let title = Value::String(case.title.clone());
        lay_over(&mut experiment.value, overlay.clone());
        lay_over(&mut experiment.value, [("title".to_owned(), title)].into_iter().collect());
        let folder = path.parent().and_then(Path::parent).unwrap_or(Path::new(""));
        let name = path.file_name().unwrap_or_default();
        let runs = Trials::of(&experiment, &folder.join(name))?;
        let mut trials = Vec::new();
        for change in [Change::default()].iter().chain(&case.changes) {
            for run in 0..runs.count() {
                let problem = if change.label().is_empty() {
                    Arc::clone(runs.problem(run))
                } else {
                    let changed = change.of(&runs.problem(run).space.scene).map_err(|error| {
                        document.fault(&lab::Place::of("changes"), error.to_string())
                    })?;
                    runs.problem_of(run, &changed)?
                };
                let labels = [runs.label(run), change.label()];
                let labels: Vec<String> = labels.into_iter().filter(|l| !l.is_empty()).collect();
                let (label, outcome) = (labels.join(", "), OnceCell::new());
                trials.push(Trial { label, change: *change, problem, run, outcome });
            }
        }
        let scene = experiment.value["scene"].as_str().unwrap_or_default();
        let (warnings, scene_file) = (runs.warnings().to_vec(), folder.join(scene));
        Ok(Bench { case, warnings, trials, runs, scene_file })
    }

    /// The light of a trial.
    ///
    /// # Errors
    /// Why the run did not end.
    pub fn outcome<'t>(&self, trial: &'t Trial) -> Result<&'t Outcome, String> {
        let found = trial.outcome.get_or_init(|| self.runs.outcome(trial.run, &trial.problem));
        found.as_ref().map_err(Clone::clone)
    }

    /// All of them.
    ///
    /// # Errors
    /// Why a run did not end.
    pub fn outcomes(&self) -> Result<Vec<(&Trial, &Outcome)>, String> {
        self.trials.iter().map(|trial| Ok((trial, self.outcome(trial)?))).collect()
    }
}

/// Puts fields in the place of others, those of objects one by one.
fn lay_over(value: &mut Value, fields: Overlay) {
    let Value::Object(object) = value else { return };
    for (name, field) in fields {
        match (object.get_mut(&name), field) {
            (Some(inner @ Value::Object(_)), Value::Object(fields)) => lay_over(inner, fields),
            (_, field) => _ = object.insert(name, field),
        }
    }
}
