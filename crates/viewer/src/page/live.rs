//! A page that shows runs while they are under way.

use std::sync::Arc;

use multicomputer::Machine;
use serde_json::{Value, json};
use virtwall::Problem;

use super::assets::{MARKUP, index_element, live_program};
use crate::pack::{geometry, machine_layout};

/// A run that the page can follow.
pub struct LiveRun<'a> {
    /// Its name, unique in the page.
    pub label: String,
    /// Its scene's name.
    pub scene: String,
    /// What is simulated.
    pub problem: &'a Arc<Problem>,
    /// The machine that it is simulated on.
    pub machine: &'a Machine,
    /// The number of processors.
    pub processors: usize,
    /// The processor of each environment.
    pub owners: Vec<usize>,
}

/// The viewer's part of a page that fetches its data, and the blocks of scenes that it fetches.
pub struct LivePage {
    /// The viewer's elements.
    pub html: String,
    problems: Vec<Arc<Problem>>,
}

impl LivePage {
    /// The page of `runs`; `updates` is the URL of the stream of server-sent events.
    pub fn of(runs: &[LiveRun], updates: &str) -> LivePage {
        let mut problems: Vec<Arc<Problem>> = Vec::new();
        let mut scenes = Vec::new();
        let mut entries = Vec::new();
        for run in runs {
            let known = problems.iter().position(|problem| Arc::ptr_eq(problem, run.problem));
            let scene = known.unwrap_or_else(|| {
                problems.push(Arc::clone(run.problem));
                let number = problems.len() - 1;
                scenes.push(json!({ "name": run.scene, "block": LivePage::block_name(number) }));
                number
            });
            entries.push(json!({
                "label": run.label,
                "group": entries.len(),
                "scene": scene,
                "processors": run.processors,
                "owners": run.owners,
                "machine": machine_layout(run.machine, run.processors),
            }));
        }
        let index =
            json!({ "scenes": scenes, "runs": entries, "updates": updates, "note": Value::Null });
        let html = format!("{MARKUP}{}{}", index_element(&index), live_program());
        LivePage { html, problems }
    }

    fn block_name(number: usize) -> String {
        format!("scene-{number}")
    }

    /// The block of this name, if the page has one.
    pub fn block(&self, name: &str) -> Option<String> {
        let number = (0..self.problems.len()).find(|&n| LivePage::block_name(n) == name)?;
        Some(geometry(&self.problems[number]).pack())
    }
}
