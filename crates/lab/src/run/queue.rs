//! Which run is next. Runs of one problem share kept shots, so workers spread over the problems; the largest
//! problem goes first.

use std::sync::Arc;

use virtwall::{KeptShots, ShotCounts};

use crate::planning::plan::Plan;

pub struct Queue {
    problems: Vec<Waiting>,
    counts: ShotCounts,
}

struct Waiting {
    /// In reverse of the plan's order, to be taken from the end.
    runs: Vec<usize>,
    active: usize,
    patches: usize,
    kept: Option<Arc<KeptShots>>,
}

pub struct Task {
    pub run: usize,
    pub problem: usize,
    /// Shots kept from other runs of the same problem.
    pub kept: Arc<KeptShots>,
}

impl Queue {
    pub fn new(plan: &Plan, waiting: impl Iterator<Item = usize>) -> Queue {
        let empty = |patches| Waiting { runs: Vec::new(), active: 0, patches, kept: None };
        let mut problems: Vec<Waiting> =
            plan.problems.iter().map(|prepared| empty(prepared.problem.patches())).collect();
        for run in waiting {
            problems[plan.runs[run].problem].runs.push(run);
        }
        problems.iter_mut().for_each(|problem| problem.runs.reverse());
        Queue { problems, counts: ShotCounts::default() }
    }

    /// The next run: of the problem with the fewest workers, then one already begun, then the one with the
    /// most patches. `kept` makes the store of shots for the first run of a problem.
    pub fn take(&mut self, kept: impl FnOnce(usize) -> KeptShots) -> Option<Task> {
        let waiting = self.problems.iter_mut().enumerate().filter(|(_, p)| !p.runs.is_empty());
        let (index, problem) =
            waiting.min_by_key(|(_, p)| (p.active, p.kept.is_none(), usize::MAX - p.patches))?;
        let run = problem.runs.pop()?;
        problem.active += 1;
        let kept = problem.kept.get_or_insert_with(|| Arc::new(kept(index)));
        Some(Task { run, problem: index, kept: Arc::clone(kept) })
    }

    /// Records that a run has ended. A problem's kept shots are dropped after its last run.
    pub fn done(&mut self, task: &Task) {
        let problem = &mut self.problems[task.problem];
        problem.active -= 1;
        if problem.active == 0 && problem.runs.is_empty() {
            self.counts += problem.kept.take().map_or(ShotCounts::default(), |kept| kept.counts());
        }
    }

    /// Shots that finished problems asked for: found or cast.
    pub fn counts(&self) -> ShotCounts {
        self.counts
    }
}
