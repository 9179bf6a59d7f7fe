//! The page that shows a plan's runs while they are under way.

use viewer::{LivePage, LiveRun};

use crate::engine::simulator;
use crate::planning::plan::Plan;
use crate::results::report;

/// The page, whole, and the blocks that it asks for by name; `updates` is the address of its news of runs.
pub fn live_page(plan: &Plan, updates: &str) -> (String, LivePage) {
    let runs = plan.runs.iter().map(|run| {
        let problem = &plan.problems[run.problem].problem;
        LiveRun {
            label: plan.label(run),
            scene: run.point.scene.clone(),
            problem,
            machine: &plan.machines[run.machine].machine,
            processors: run.point.processors as usize,
            owners: simulator::owners(&run.point, problem),
        }
    });
    let page = LivePage::of(&runs.collect::<Vec<_>>(), updates);
    (report::page(&plan.title, viewer::STYLE, &page.html), page)
}
