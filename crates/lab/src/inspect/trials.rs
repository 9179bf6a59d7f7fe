//! Single runs of an experiment, on its own scene or on another, for callers that need the light and no table.

use std::path::Path;
use std::sync::Arc;

use config::{Document, Fault};
use virtwall::{KeptShots, Outcome, Problem};

use crate::engine::simulator;
use crate::experiment::sweep::in_words;
use crate::open::problem;
use crate::planning::plan::Plan;
use crate::planning::preparing::Preparing;

/// Host memory for the shots that a run keeps, bytes.
const MEMORY: usize = 256 << 20;

/// An experiment, validated and ready to be run.
pub struct Trials {
    plan: Plan,
    file: String,
}

impl Trials {
    /// Validates an experiment that is part of another file, as if it were the file at `path`.
    pub fn of(document: &Document, path: &Path) -> Result<Trials, Fault> {
        Ok(Trials {
            plan: Plan::of(path, document.clone(), &[], &Preparing::default())?,
            file: document.file.clone(),
        })
    }

    /// How many runs there are: the product of all lists.
    pub fn count(&self) -> usize {
        self.plan.runs.len()
    }

    /// The swept fields of a run, such as "cut 2x2x1".
    pub fn label(&self, run: usize) -> String {
        let swept = self.plan.swept(&self.plan.runs[run]);
        let fields = swept.map(|(field, value)| format!("{field} {}", in_words(value)));
        fields.collect::<Vec<_>>().join(", ")
    }

    /// What was corrected in the scenes.
    pub fn warnings(&self) -> &[String] {
        &self.plan.warnings
    }

    /// The problem of a run.
    pub fn problem(&self, run: usize) -> &Arc<Problem> {
        &self.plan.problems[self.plan.runs[run].problem].problem
    }

    /// The problem that another scene makes under a run's settings.
    pub fn problem_of(&self, run: usize, scene: &radiosity::Scene) -> Result<Arc<Problem>, Fault> {
        let settings = &self.plan.problems[self.plan.runs[run].problem].settings;
        problem::problem(scene, settings)
            .map_err(|(field, message)| Fault::of_file(&self.file, format!("{field}: {message}")))
    }

    /// Runs a problem as a run says, on its simulated machine.
    pub fn outcome(&self, run: usize, problem: &Arc<Problem>) -> Result<Outcome, String> {
        let run = &self.plan.runs[run];
        let machine = &self.plan.machines[run.machine].machine;
        let kept = Arc::new(KeptShots::new(MEMORY));
        let made = simulator::run(problem, &run.point, &kept, Arc::new(|_| ()));
        simulator::outcome(&made, &run.point, machine)
    }
}
