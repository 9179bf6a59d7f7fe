//! Recorded runs for the report's viewer.

use std::sync::Arc;

use radiosity::Rgb;
use viewer::{RecordedRun, ReportParts};

use crate::accuracy::errors::laid_on;
use crate::engine::simulator;
use crate::planning::plan::{Plan, all_else};
use crate::run::runner::Endings;

/// Approximate limit of the bytes of recordings in a report.
const LIMIT: usize = 19_000_000;

/// The recordings of a plan's runs, packed by `threads` threads; none if no run was recorded.
pub fn recorded(plan: &Plan, endings: &Endings, threads: usize) -> Option<ReportParts> {
    let mut groups: Vec<(usize, Vec<usize>)> = Vec::new();
    let mut answers: Vec<Option<Arc<Vec<Rgb>>>> = vec![None; plan.problems.len()];
    let mut recordings = Vec::new();
    for (run, recording) in plan.runs.iter().zip(&endings.recordings) {
        let Some(recording) = recording else { continue };
        let key = (run.problem, all_else(plan, run, "processors"));
        let group = groups.iter().position(|known| *known == key).unwrap_or(groups.len());
        if group == groups.len() {
            groups.push(key);
        }
        let problem = &plan.problems[run.problem].problem;
        if answers[run.problem].is_none() {
            let answer = plan.answer(run, &endings.dense);
            answers[run.problem] = answer.map(|answer| Arc::new(laid_on(&answer, problem)));
        }
        let published = plan.comparison.of(&run.point.scene, run.point.processors);
        recordings.push(RecordedRun {
            label: plan.label(run),
            scene: run.point.scene.clone(),
            group,
            problem,
            machine: &plan.machines[run.machine].machine,
            owners: simulator::owners(&run.point, problem),
            answer: answers[run.problem].clone(),
            published: published.speed_up.parse().ok(),
            recording,
        });
    }
    (!recordings.is_empty()).then(|| ReportParts::of(&recordings, LIMIT, threads))
}
