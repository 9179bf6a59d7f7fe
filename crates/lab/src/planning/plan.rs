//! An experiment file, read, expanded and validated. Nothing in a plan is refused later.

use std::sync::Arc;

use config::Place;
use multicomputer::Machine;
use serde_json::Value;
use virtwall::Problem;

use crate::accuracy::answer::{Answer, DenseAnswers, Stored};
use crate::accuracy::tuned::Tuned;
use crate::experiment::fields::Experiment;
use crate::experiment::plot::Plot;
use crate::experiment::sweep::{Axis, in_words};
use crate::files::digest::FileDigest;
use crate::open::settings::Settings;
use crate::table::column::{Column, Input};
use crate::table::columns;
use crate::table::comparison::Comparison;

/// All that an experiment will do.
pub struct Plan {
    /// The experiment file's name without its ending: results go to `results/<name>`.
    pub name: String,
    /// The experiment's title.
    pub title: String,
    /// The experiment file with its arguments and every default filled in.
    pub(crate) resolved: Value,
    pub(crate) axes: Vec<Axis>,
    /// In the order of the results.
    pub runs: Vec<Run>,
    /// Scenes, meshed and cut.
    pub problems: Vec<Prepared>,
    /// The machines of the runs.
    pub machines: Vec<Equipment>,
    pub(crate) references: Vec<Stored>,
    pub(crate) comparison: Comparison,
    pub(crate) plots: Vec<Plot>,
    /// What was corrected in the scenes.
    pub warnings: Vec<String>,
    /// All files read, each once, by label.
    pub(crate) files: Vec<FileDigest>,
}

impl Plan {
    /// Processors of the runs that speed-ups are relative to.
    pub fn speed_up_base(&self) -> u32 {
        self.runs[0].point.speed_up_over.unwrap_or(1)
    }

    /// The same plan, whose title says what was changed: `path=value` arguments.
    pub fn changed(mut self, changes: &[String]) -> Plan {
        if !changes.is_empty() && !changes.iter().any(|change| change.starts_with("title=")) {
            self.title += &format!(" ({})", changes.join(", "));
            self.resolved["title"] = self.title.clone().into();
        }
        self
    }

    /// The settings that were found, a sentence each.
    pub fn settings_found(&self) -> Vec<String> {
        let found = self.runs.iter().filter_map(|run| Some(run.tuned?.sentence(&run.point.scene)));
        let mut sentences: Vec<String> = found.collect();
        sentences.dedup();
        sentences
    }

    /// A label that identifies a run: scene, processors and all other swept fields.
    pub fn label(&self, run: &Run) -> String {
        let plural = if run.point.processors == 1 { "" } else { "s" };
        let mut label = format!("{}, {} processor{plural}", run.point.scene, run.point.processors);
        for (field, value) in self.swept(run) {
            if ![Place::of("scene"), Place::of("processors")].contains(field) {
                label += &format!(", {field} {}", in_words(value));
            }
        }
        label
    }

    /// The columns of its results, without the swept fields.
    pub(crate) fn columns(&self) -> Vec<&'static Column> {
        columns::shown(&self.runs.iter().map(|run| self.input(run)).collect::<Vec<_>>())
    }

    pub(crate) fn input<'a>(&'a self, run: &'a Run) -> Input<'a> {
        Input {
            point: &run.point,
            machine: &self.machines[run.machine].machine,
            problem: &self.problems[run.problem].problem,
            tuned: run.tuned.as_ref(),
        }
    }

    /// The swept fields, and the values that a run has of them.
    pub(crate) fn swept<'a>(
        &'a self,
        run: &'a Run,
    ) -> impl Iterator<Item = (&'a Place, &'a Value)> {
        self.axes.iter().zip(&run.index).map(|(axis, &item)| (&axis.place, &axis.values[item]))
    }

    /// The answer that a run is compared with, if any: a stored one, or one of `dense`.
    pub(crate) fn answer(&self, run: &Run, dense: &DenseAnswers) -> Option<Arc<Answer>> {
        run.point.reference.as_ref()?;
        Some(match run.stored {
            Some(stored) => Arc::clone(&self.references[stored].answer),
            None => dense.of(&self.problems[run.problem].problem),
        })
    }
}

pub struct Run {
    /// Which value of each axis it has.
    pub index: Vec<usize>,
    pub point: Experiment,
    /// Index into [`Plan::problems`].
    pub problem: usize,
    /// Index into [`Plan::machines`].
    pub machine: usize,
    /// Index into [`Plan::references`]; none where a run has no reference, or a dense one.
    pub stored: Option<usize>,
    /// How its settings were found, if the experiment asks for an accuracy.
    pub tuned: Option<Tuned>,
}

/// A scene, meshed and cut.
pub struct Prepared {
    pub settings: Settings,
    pub problem: Arc<Problem>,
    pub digests: Vec<FileDigest>,
    /// Bytes of its geometry and materials.
    pub scene_bytes: u64,
    /// CPU seconds that reading, cleaning, cutting and meshing took.
    pub set_up_s: f64,
}

/// A machine and the file it was read from.
pub struct Equipment {
    pub machine: Machine,
    /// Its file, and those that it extends.
    pub digests: Vec<FileDigest>,
}

/// Which value a run has of each swept field but `field`.
pub fn all_else(plan: &Plan, run: &Run, field: &str) -> Vec<usize> {
    let field = Place::of(field);
    let fields = plan.axes.iter().zip(&run.index).filter(|(axis, _)| axis.place != field);
    fields.map(|(_, &item)| item).collect()
}
