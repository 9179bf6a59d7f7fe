//! An experiment file read, expanded and validated, once, at the door: nothing in a plan can be
//! refused later.

use std::path::Path;

use multicomputer::Machine;
use serde_json::Value;

use crate::comparison::Comparison;
use crate::digest::FileDigest;
use crate::document::Document;
use crate::engine::Problem;
use crate::experiment::{Experiment, Plot};
use crate::fault::Fault;
use crate::planner::Planner;
use crate::problem::Settings;
use crate::schema::experiment_schema;
use crate::sweep::{Axis, Sweep};

/// All that an experiment will do.
pub struct Plan {
    /// The experiment file's name without its ending: results go to `results/<name>`.
    pub name: String,
    /// The experiment's title.
    pub title: String,
    /// The experiment file with its arguments and every default filled in.
    pub resolved: Value,
    /// The swept fields.
    pub axes: Vec<Axis>,
    /// The runs, in the order of the results.
    pub runs: Vec<Run>,
    /// Scenes, meshed and cut.
    pub problems: Vec<Prepared>,
    /// Machines.
    pub machines: Vec<Equipment>,
    /// Published figures.
    pub comparison: Comparison,
    /// What to draw.
    pub plots: Vec<Plot>,
    /// What was mended in the scenes.
    pub warnings: Vec<String>,
    /// All files read, each once, by label.
    pub files: Vec<FileDigest>,
}

/// One run.
pub struct Run {
    /// Which value of each axis it has.
    pub index: Vec<usize>,
    /// Its settings as the file gives them.
    pub point: Experiment,
    /// Index into [`Plan::problems`].
    pub problem: usize,
    /// Index into [`Plan::machines`].
    pub machine: usize,
}

/// A scene, meshed and cut.
pub struct Prepared {
    /// How.
    pub settings: Settings,
    /// The problem.
    pub problem: Problem,
    /// The scene's files.
    pub digests: Vec<FileDigest>,
}

/// A machine and the file it was read from.
pub struct Equipment {
    /// The machine.
    pub machine: Machine,
    /// Its file.
    pub digest: FileDigest,
}

impl Plan {
    /// Reads an experiment file, lays `--set path=value` arguments over it, and validates all of
    /// it, the scenes and machines that it names included.
    ///
    /// # Errors
    /// The first fault met. Nothing was written.
    pub fn read(path: &Path, arguments: &[String]) -> Result<Plan, Fault> {
        let mut document = Document::read(path)?;
        for argument in arguments {
            document.set(argument)?;
        }
        document.refuse_unknown_keys(&experiment_schema())?;
        let sweep = Sweep::of(&document)?;
        Planner::new(path, &document, &sweep).plan()
    }
}
