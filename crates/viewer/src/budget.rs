//! Which recorded runs a report has room for.

use std::sync::Arc;

use virtwall::Problem;

use crate::reel::Told;

/// About what things take in a report, bytes: found on Table 1, and on the safe side.
const PATCH: usize = 5;
const HIT: usize = 3;
const SPAN: usize = 6;
const MESSAGE: usize = 6;

/// Whether each run is shown: all, or else of every group those on the fewest and the most processors,
/// or else as many of these as there is room for, from the first on.
pub(crate) fn affordable(told: &[Told], limit: usize) -> Vec<bool> {
    let all = vec![true; told.len()];
    if cost(told, &all) <= limit {
        return all;
    }
    let ends = ends(told);
    let mut shown = vec![false; told.len()];
    for run in (0..told.len()).filter(|&run| ends[run]) {
        shown[run] = true;
        shown[run] = cost(told, &shown) <= limit;
    }
    shown
}

fn ends(told: &[Told]) -> Vec<bool> {
    let end = |one: &Told| {
        let group = told.iter().filter(|other| other.reel.group == one.reel.group);
        let processors = || group.clone().map(Told::processors);
        [processors().min(), processors().max()].contains(&Some(one.processors()))
    };
    told.iter().map(end).collect()
}

/// About what a report of these runs takes.
fn cost(told: &[Told], shown: &[bool]) -> usize {
    let mut problems: Vec<(&Arc<Problem>, usize)> = Vec::new();
    let mut sum = 0;
    for (one, _) in told.iter().zip(shown).filter(|(_, shown)| **shown) {
        let film = one.reel.film;
        let hits: usize = film.beams.iter().flatten().map(|beam| beam.hits.len()).sum();
        // Runs of a problem share their shots.
        let known = problems.iter_mut().find(|(p, _)| Arc::ptr_eq(p, one.reel.problem));
        match known {
            Some((_, most)) => *most = hits.max(*most),
            None => problems.push((one.reel.problem, hits)),
        }
        // A shot goes with a selection, some sending and some receiving.
        let shots: usize = film.beams.iter().map(Vec::len).sum();
        sum += 5 * SPAN * shots + MESSAGE * film.recording.messages.len();
    }
    sum + problems
        .iter()
        .map(|(problem, hits)| PATCH * problem.patches() + HIT * hits)
        .sum::<usize>()
}
