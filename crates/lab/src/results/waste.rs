//! Warnings of runs that made many more shots than one processor needs.

use std::collections::BTreeMap;

use crate::engine::simulator::most_shots_in_sequence;
use crate::planning::plan::{Plan, Run, all_else};
use crate::run::runner::Endings;

/// A run that makes more than this many times the shots of one processor is warned of.
const TIMES: f64 = 2.0;

/// Warnings of runs that made many more shots of patches than the same run on one processor, or than one
/// processor can need.
///
/// A processor with little to do shoots whatever arrives, however little, while light waits in the queue of
/// another. The run ends, but later than with fewer processors.
pub fn waste(plan: &Plan, endings: &Endings) -> Vec<String> {
    let shots = |number: usize| Some(endings.runs[number].as_ref()?.as_ref().ok()?.local_shots);
    let runs = || plan.runs.iter().enumerate();
    let same = |run: &Run| all_else(plan, run, "processors");
    let alone = runs().filter(|(_, run)| run.point.processors == 1);
    let alone: BTreeMap<Vec<usize>, u64> =
        alone.filter_map(|(number, run)| Some((same(run), shots(number)?))).collect();
    let warning = |(number, run): (usize, &Run)| {
        let shots = shots(number)?;
        let of_one = match alone.get(&same(run)) {
            Some(&one) => {
                let times = shots as f64 / one.max(1) as f64;
                (times > TIMES).then(|| format!("{times:.1} times the {one} on one processor"))
            }
            None => {
                let problem = &plan.problems[run.problem].problem;
                let most = most_shots_in_sequence(problem, &run.point)?;
                let too_many = shots as f64 > most;
                too_many.then(|| format!("one processor needs {most:.0} at most"))
            }
        }?;
        Some(format!(
            "{}: {shots} shots of patches, {of_one}: processors with little to do shoot the least light that \
             arrives, while others fall behind; a higher \"stop.patch_threshold\", another \"mapping\" or fewer \
             processors avoid it",
            plan.label(run)
        ))
    };
    runs().filter_map(warning).collect()
}
