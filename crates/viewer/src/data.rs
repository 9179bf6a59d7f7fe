//! What the page's program reads: blocks of data, and an index of what lies where.

use std::sync::Arc;
use std::thread;

use serde_json::{Value, json};
use virtwall::Problem;

use crate::budget::affordable;
use crate::columns::Columns;
use crate::reel::{Told, places};
use crate::run;
use crate::scene::{Shots, geometry};

/// The most messages of a run that a report holds.
const MOST_MESSAGES: usize = 60_000;

/// The blocks of a page, by their names, and what lies where.
pub(crate) struct Data {
    pub index: Value,
    blocks: Vec<(String, Columns)>,
}

impl Data {
    /// Of as many of the runs as `limit` bytes have room for, about.
    pub fn of(told: &[Told], limit: usize) -> Data {
        let shown = affordable(told, limit);
        let recorded = told.len();
        let told: Vec<&Told> =
            told.iter().zip(&shown).filter(|(_, shown)| **shown).map(|(told, _)| told).collect();
        let mut problems: Vec<&Arc<Problem>> = Vec::new();
        for one in &told {
            if !problems.iter().any(|problem| Arc::ptr_eq(problem, one.reel.problem)) {
                problems.push(one.reel.problem);
            }
        }
        let mut data = Data { index: Value::Null, blocks: Vec::new() };
        let mut scenes = Vec::new();
        let mut runs = vec![Value::Null; told.len()];
        for (number, problem) in problems.into_iter().enumerate() {
            let mine: Vec<usize> = (0..told.len())
                .filter(|&run| Arc::ptr_eq(told[run].reel.problem, problem))
                .collect();
            let shots = Shots::of(mine.iter().map(|&run| told[run].reel.film));
            scenes.push(data.scene(number, told[mine[0]], &shots));
            for run in mine {
                runs[run] = data.run(run, told[run], number, &shots);
            }
        }
        data.index = json!({
            "scenes": scenes,
            "runs": runs,
            "first": first(&told),
            "note": note(&told, recorded),
        });
        data
    }

    /// The blocks of a scene.
    fn scene(&mut self, number: usize, one: &Told, shots: &Shots) -> Value {
        let problem = one.reel.problem;
        let reference = one.reel.answer.as_ref().map(|answer| {
            let mut columns = Columns::default();
            columns.floats(answer.iter().flat_map(|rgb| rgb.to_array()));
            self.add(format!("reference-{number}"), columns)
        });
        json!({
            "name": one.reel.scene,
            "block": self.add(format!("scene-{number}"), geometry(problem)),
            "shots": self.add(format!("shots-{number}"), shots.columns(problem)),
            "reference": reference,
        })
    }

    /// The block of a run.
    fn run(&mut self, number: usize, told: &Told, scene: usize, shots: &Shots) -> Value {
        let Told { reel, path, .. } = told;
        let columns = run::columns(reel.film, &reel.owners, shots, path, every(told));
        json!({
            "label": reel.label,
            "group": reel.group,
            "scene": scene,
            "processors": told.processors(),
            "time_s": told.seconds(),
            "machine": places(reel.machine, told.processors()),
            "block": self.add(format!("run-{number}"), columns),
        })
    }

    fn add(&mut self, name: String, columns: Columns) -> String {
        self.blocks.push((name.clone(), columns));
        name
    }

    /// All blocks as elements of the page; they are packed side by side.
    pub fn packed(&self) -> String {
        let threads = thread::available_parallelism().map_or(1, |threads| threads.get());
        let part = self.blocks.len().div_ceil(threads).max(1);
        let pack = |blocks: &[(String, Columns)]| -> String {
            let element = |(name, columns): &(String, Columns)| {
                let packed = columns.pack();
                format!(
                    "<script type=\"application/octet-stream\" id=\"{name}\">{packed}</script>\n"
                )
            };
            blocks.iter().map(element).collect()
        };
        thread::scope(|scope| {
            let workers: Vec<_> =
                self.blocks.chunks(part).map(|blocks| scope.spawn(move || pack(blocks))).collect();
            let texts = workers.into_iter().map(|worker| worker.join());
            // A packer cannot panic; if one does, so does this.
            texts
                .map(|text| text.unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
                .collect()
        })
    }
}

/// One message of so many of a run is told.
fn every(told: &Told) -> usize {
    told.reel.film.recording.messages.len().div_ceil(MOST_MESSAGES).max(1)
}

/// What of all that was recorded is here.
fn note(told: &[&Told], recorded: usize) -> String {
    let mut sampled = Vec::new();
    if told.len() < recorded {
        let here = told.len();
        sampled.push(format!(
            "{here} of {recorded} recorded runs are here; with more the page would be too large"
        ));
    }
    for one in told.iter().filter(|one| every(one) > 1) {
        sampled.push(format!("{}: one message of {}", one.reel.label, every(one)));
    }
    match sampled.is_empty() {
        true => "All that was recorded is here: every shot, span and message.".to_owned(),
        false => format!("Not all that was recorded is here. {}.", sampled.join("; ")),
    }
}

/// The run that is shown first: of the first group the one on the most processors.
fn first(told: &[&Told]) -> usize {
    let group = told.first().map_or(0, |one| one.reel.group);
    let mine = told.iter().enumerate().filter(|(_, one)| one.reel.group == group);
    mine.max_by_key(|(_, one)| one.processors()).map_or(0, |(run, _)| run)
}
