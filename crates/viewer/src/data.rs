//! What the page's program reads: blocks of data, and an index of what lies where.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::{self, ScopedJoinHandle};

use serde_json::{Value, json};
use virtwall::Problem;

use crate::budget::affordable;
use crate::columns::Columns;
use crate::reel::{Told, places};
use crate::run;
use crate::scene::{Shots, geometry};

/// The most messages of a run that a report holds.
const MOST_MESSAGES: usize = 60_000;

/// Makes the columns of a block, on whatever thread.
type Block<'a> = Box<dyn Fn() -> Columns + Sync + 'a>;

/// The blocks of a page, by their names, and what lies where.
pub(crate) struct Data<'a> {
    pub index: Value,
    blocks: Vec<(String, Block<'a>)>,
}

impl<'a> Data<'a> {
    /// Of as many of the runs as `limit` bytes have room for, about.
    pub fn of(told: &'a [Told], limit: usize) -> Data<'a> {
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
            let shots = Arc::new(Shots::of(mine.iter().map(|&run| told[run].reel.film)));
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
    fn scene(&mut self, number: usize, one: &'a Told, shots: &Arc<Shots<'a>>) -> Value {
        let problem = one.reel.problem;
        let reference = one.reel.answer.as_ref().map(|answer| {
            self.add(format!("reference-{number}"), || {
                let mut columns = Columns::default();
                columns.floats(answer.iter().flat_map(|rgb| rgb.to_array()));
                columns
            })
        });
        let shots = Arc::clone(shots);
        json!({
            "name": one.reel.scene,
            "block": self.add(format!("scene-{number}"), || geometry(problem)),
            "shots": self.add(format!("shots-{number}"), move || shots.columns(problem)),
            "reference": reference,
        })
    }

    /// The block of a run.
    fn run(
        &mut self,
        number: usize,
        told: &'a Told,
        scene: usize,
        shots: &Arc<Shots<'a>>,
    ) -> Value {
        let Told { reel, path, .. } = told;
        let shots = Arc::clone(shots);
        let columns = move || run::columns(reel.film, &reel.owners, &shots, path, every(told));
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

    fn add(&mut self, name: String, block: impl Fn() -> Columns + Sync + 'a) -> String {
        self.blocks.push((name.clone(), Box::new(block)));
        name
    }

    /// All blocks as elements of the page, made side by side by so many threads, at least 1.
    pub fn packed(&self, threads: usize) -> String {
        let element = |(name, block): &(String, Block)| {
            let packed = block().pack();
            format!("<script type=\"application/octet-stream\" id=\"{name}\">{packed}</script>\n")
        };
        let next = AtomicUsize::new(0);
        let work = || {
            let numbers = std::iter::repeat_with(|| next.fetch_add(1, Ordering::Relaxed));
            let mine = numbers.map_while(|n| Some((n, element(self.blocks.get(n)?))));
            mine.collect::<Vec<(usize, String)>>()
        };
        let mut made: Vec<(usize, String)> = thread::scope(|scope| {
            let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
            // A packer cannot panic; if one does, so does this.
            let join = |worker: ScopedJoinHandle<Vec<_>>| {
                worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
            };
            workers.into_iter().flat_map(join).collect()
        });
        made.sort_unstable_by_key(|&(number, _)| number);
        made.into_iter().map(|(_, text)| text).collect()
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
