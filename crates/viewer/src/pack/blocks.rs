//! The blocks of data of a report, and the index by which the page finds them.

use std::sync::Arc;

use serde_json::{Value, json};
use virtwall::Problem;

use super::budget::fitting;
use super::run::run_columns;
use super::shots::Shots;
use super::{Columns, geometry, machine_layout};
use crate::explain::AnalysedRun;

/// The most messages of a run that a report holds.
const MOST_MESSAGES: usize = 60_000;

/// Makes the columns of a block, on any thread.
type Block<'a> = Box<dyn Fn() -> Columns + Sync + 'a>;

/// The blocks of a page by name, and their index.
pub(crate) struct Blocks<'a> {
    /// Scenes and runs with the names of their blocks.
    pub index: Value,
    blocks: Vec<(String, Block<'a>)>,
}

impl<'a> Blocks<'a> {
    /// The blocks of as many runs as fit into about `limit` bytes.
    pub fn of(runs: &'a [AnalysedRun], limit: usize) -> Blocks<'a> {
        let recorded = runs.len();
        let shown = fitting(runs, limit);
        let runs: Vec<&AnalysedRun> =
            runs.iter().zip(shown).filter_map(|(run, shown)| shown.then_some(run)).collect();
        let mut problems: Vec<&Arc<Problem>> = Vec::new();
        for one in &runs {
            if !problems.iter().any(|problem| Arc::ptr_eq(problem, one.run.problem)) {
                problems.push(one.run.problem);
            }
        }
        let mut blocks = Blocks { index: Value::Null, blocks: Vec::new() };
        let mut scenes = Vec::new();
        let mut entries = vec![Value::Null; runs.len()];
        for (scene, problem) in problems.into_iter().enumerate() {
            let of_problem: Vec<usize> = (0..runs.len())
                .filter(|&number| Arc::ptr_eq(runs[number].run.problem, problem))
                .collect();
            let recordings = of_problem.iter().map(|&number| runs[number].run.recording);
            let shots = Arc::new(Shots::of(recordings));
            scenes.push(blocks.scene(scene, runs[of_problem[0]], &shots));
            for number in of_problem {
                entries[number] = blocks.run(number, runs[number], scene, &shots);
            }
        }
        blocks.index = json!({
            "scenes": scenes,
            "runs": entries,
            "first": first(&runs),
            "note": note(&runs, recorded),
        });
        blocks
    }

    /// Adds the blocks of a scene; `one` is a run of it.
    fn scene(&mut self, number: usize, one: &'a AnalysedRun, shots: &Arc<Shots<'a>>) -> Value {
        let problem = one.run.problem;
        let reference = one.run.answer.as_ref().map(|answer| {
            self.add(format!("reference-{number}"), || {
                let mut columns = Columns::default();
                columns.floats(answer.iter().flat_map(|rgb| rgb.to_array()));
                columns
            })
        });
        let shots = Arc::clone(shots);
        json!({
            "name": one.run.scene,
            "block": self.add(format!("scene-{number}"), || geometry(problem)),
            "shots": self.add(format!("shots-{number}"), move || shots.columns(problem)),
            "reference": reference,
        })
    }

    fn run(
        &mut self,
        number: usize,
        one: &'a AnalysedRun,
        scene: usize,
        shots: &Arc<Shots<'a>>,
    ) -> Value {
        let AnalysedRun { run, path, .. } = one;
        let shots = Arc::clone(shots);
        let columns = move || run_columns(run.recording, &run.owners, &shots, path, every(one));
        json!({
            "label": run.label,
            "group": run.group,
            "scene": scene,
            "processors": one.processors(),
            "time_s": one.seconds(),
            "machine": machine_layout(run.machine, one.processors()),
            "block": self.add(format!("run-{number}"), columns),
        })
    }

    fn add(&mut self, name: String, block: impl Fn() -> Columns + Sync + 'a) -> String {
        self.blocks.push((name.clone(), Box::new(block)));
        name
    }

    /// All blocks as elements of the page, made on `threads` threads, at least 1.
    pub fn pack(&self, threads: usize) -> String {
        let element = |number: usize| {
            let (name, block) = &self.blocks[number];
            let packed = block().pack();
            format!("<script type=\"application/octet-stream\" id=\"{name}\">{packed}</script>\n")
        };
        parallel::map(self.blocks.len(), threads, element).concat()
    }
}

/// The page holds one message of this number of messages.
fn every(run: &AnalysedRun) -> usize {
    run.run.recording.recording.messages.len().div_ceil(MOST_MESSAGES).max(1)
}

/// What the page leaves out of what was recorded.
fn note(runs: &[&AnalysedRun], recorded: usize) -> String {
    let mut omissions = Vec::new();
    if runs.len() < recorded {
        let here = runs.len();
        omissions.push(format!(
            "{here} of {recorded} recorded runs are here; with more the page would be too large"
        ));
    }
    for one in runs.iter().filter(|one| every(one) > 1) {
        omissions.push(format!("{}: one message of {}", one.run.label, every(one)));
    }
    match omissions.is_empty() {
        true => "All that was recorded is here: every shot, span and message.".to_owned(),
        false => format!("Not all that was recorded is here. {}.", omissions.join("; ")),
    }
}

/// The run that is shown first: of the first group the one on the most processors.
fn first(runs: &[&AnalysedRun]) -> usize {
    let group = runs.first().map_or(0, |one| one.run.group);
    let of_group = runs.iter().enumerate().filter(|(_, one)| one.run.group == group);
    of_group.max_by_key(|(_, one)| one.processors()).map_or(0, |(number, _)| number)
}
