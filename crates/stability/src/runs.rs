//! The runs of a case: on its scene, and on each changed scene.

use std::cell::OnceCell;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use config::{Document, Fault, Place, merge};
use lab::Trials;
use serde_json::{Value, json};
use virtwall::{Outcome, Problem};

use crate::cases::case::{Case, Overlay};
use crate::cases::change::Change;

/// The runs of a case. Each is simulated when its outcome is first asked for.
pub struct CaseRuns<'a> {
    pub case: &'a Case,
    /// All runs on the original scene, then all runs on each changed scene.
    pub list: Vec<CaseRun>,
    trials: Trials,
    pub scene_file: PathBuf,
}

/// One run on one scene.
pub struct CaseRun {
    /// Its swept fields and its change, for messages.
    pub label: String,
    /// The change to the scene; the default is none.
    pub change: Change,
    /// The scene, meshed and cut.
    pub problem: Arc<Problem>,
    /// Its number among the trials of the experiment.
    number: usize,
    outcome: OnceCell<Result<Outcome, String>>,
}

impl<'a> CaseRuns<'a> {
    /// Prepares a case. Fields of `overlay` replace those of its experiment; `path` is the case's file.
    pub fn new(
        case: &'a Case,
        document: &Document,
        path: &Path,
        overlay: &Overlay,
    ) -> Result<CaseRuns<'a>, Fault> {
        let mut experiment = document.clone();
        experiment.value = case.experiment.clone();
        merge(&mut experiment.value, Value::Object(overlay.clone()));
        merge(&mut experiment.value, json!({ "title": case.title }));
        let folder = path.parent().and_then(Path::parent).unwrap_or(Path::new(""));
        let name = path.file_name().unwrap_or_default();
        let trials = Trials::of(&experiment, &folder.join(name))?;
        let mut list = Vec::new();
        for change in [Change::default()].iter().chain(&case.changes) {
            for number in 0..trials.count() {
                let problem = if change.label().is_empty() {
                    Arc::clone(trials.problem(number))
                } else {
                    let changed =
                        change.of(&trials.problem(number).space.scene).map_err(|error| {
                            document.fault(&Place::of("changes"), error.to_string())
                        })?;
                    trials.problem_of(number, &changed)?
                };
                let labels = [trials.label(number), change.label()];
                let labels: Vec<String> = labels.into_iter().filter(|l| !l.is_empty()).collect();
                let (label, outcome) = (labels.join(", "), OnceCell::new());
                list.push(CaseRun { label, change: *change, problem, number, outcome });
            }
        }
        let scene = experiment.value["scene"].as_str().unwrap_or_default();
        Ok(CaseRuns { case, list, trials, scene_file: folder.join(scene) })
    }

    /// Warnings about repairs to its scenes.
    pub fn warnings(&self) -> &[String] {
        self.trials.warnings()
    }

    pub fn outcome<'t>(&self, run: &'t CaseRun) -> Result<&'t Outcome, String> {
        let found = run.outcome.get_or_init(|| self.trials.outcome(run.number, &run.problem));
        found.as_ref().map_err(Clone::clone)
    }

    pub fn outcomes(&self) -> Result<Vec<(&CaseRun, &Outcome)>, String> {
        self.list.iter().map(|run| Ok((run, self.outcome(run)?))).collect()
    }
}
