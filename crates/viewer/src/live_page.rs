//! A page that shows runs while they are under way.

use std::sync::Arc;

use multicomputer::Machine;
use serde_json::{Value, json};
use virtwall::Problem;

use crate::page::{MARKUP, index_element, script};
use crate::reel::places;
use crate::scene::geometry;

/// A run that may be shown.
pub struct LiveRun<'a> {
    /// Its name among all runs of the page.
    pub label: String,
    /// Its scene's name.
    pub scene: String,
    /// What is simulated.
    pub problem: &'a Arc<Problem>,
    /// On what.
    pub machine: &'a Machine,
    /// On how many processors.
    pub processors: usize,
    /// The processor of each environment.
    pub owners: Vec<usize>,
}

/// The viewer's part of a page whose data is yet to come, and the scenes that the page asks for.
pub struct LivePage {
    /// What stands in the page.
    pub html: String,
    problems: Vec<Arc<Problem>>,
}

impl LivePage {
    /// Of these runs; `updates` is where the page hears of them.
    pub fn of(runs: &[LiveRun], updates: &str) -> LivePage {
        let mut problems: Vec<Arc<Problem>> = Vec::new();
        let mut scenes = Vec::new();
        let mut told = Vec::new();
        for run in runs {
            let known = problems.iter().position(|problem| Arc::ptr_eq(problem, run.problem));
            let scene = known.unwrap_or_else(|| {
                problems.push(Arc::clone(run.problem));
                let number = problems.len() - 1;
                scenes.push(json!({ "name": run.scene, "block": LivePage::block_name(number) }));
                number
            });
            told.push(json!({
                "label": run.label,
                "group": told.len(),
                "scene": scene,
                "processors": run.processors,
                "owners": run.owners,
                "machine": places(run.machine, run.processors),
            }));
        }
        let index =
            json!({ "scenes": scenes, "runs": told, "updates": updates, "note": Value::Null });
        let start = [include_str!("../assets/live-run.js"), include_str!("../assets/live.js")];
        let html = format!("{MARKUP}{}{}", index_element(&index), script(&start));
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
