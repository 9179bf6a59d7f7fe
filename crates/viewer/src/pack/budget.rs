//! Which recorded runs a page has room for.

use std::sync::Arc;

use virtwall::Problem;

use crate::explain::AnalysedRun;

/// Estimated bytes in a page, measured on Table 1 and rounded up.
const PATCH: usize = 5;
const HIT: usize = 3;
const SPAN: usize = 6;
const MESSAGE: usize = 6;

/// Whether each run is shown: all if `limit` bytes have room for them; else of every group the runs on
/// the fewest and the most processors, in order, as far as there is room.
pub(super) fn fitting(runs: &[AnalysedRun], limit: usize) -> Vec<bool> {
    let all = vec![true; runs.len()];
    if estimated_bytes(runs, &all) <= limit {
        return all;
    }
    let mut shown = vec![false; runs.len()];
    for number in (0..runs.len()).filter(|&number| is_extreme(runs, &runs[number])) {
        shown[number] = true;
        shown[number] = estimated_bytes(runs, &shown) <= limit;
    }
    shown
}

/// Whether a run has the fewest or the most processors of its group.
fn is_extreme(runs: &[AnalysedRun], one: &AnalysedRun) -> bool {
    let group = runs.iter().filter(|other| other.run.group == one.run.group);
    let processors = || group.clone().map(AnalysedRun::processors);
    [processors().min(), processors().max()].contains(&Some(one.processors()))
}

fn estimated_bytes(runs: &[AnalysedRun], shown: &[bool]) -> usize {
    let mut problems: Vec<(&Arc<Problem>, usize)> = Vec::new();
    let mut sum = 0;
    for (one, _) in runs.iter().zip(shown).filter(|(_, shown)| **shown) {
        let recording = one.run.recording;
        let hits: usize = recording.shots.iter().flatten().map(|shot| shot.hits.len()).sum();
        // Runs of a problem share their shots.
        match problems.iter_mut().find(|(problem, _)| Arc::ptr_eq(problem, one.run.problem)) {
            Some((_, most)) => *most = hits.max(*most),
            None => problems.push((one.run.problem, hits)),
        }
        // Of spans, each shot brings a selection, some sending and some receiving.
        let shots: usize = recording.shots.iter().map(Vec::len).sum();
        sum += 5 * SPAN * shots + MESSAGE * recording.recording.messages.len();
    }
    let scene = |&(problem, hits): &(&Arc<Problem>, usize)| PATCH * problem.patches() + HIT * hits;
    sum + problems.iter().map(scene).sum::<usize>()
}
