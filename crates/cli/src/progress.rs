//! The progress bar, on standard error, and only on a terminal.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use indicatif::{ProgressBar, ProgressStyle};
use lab::{Event, Plan};

/// Steps of the bar for a run.
const STEPS: u64 = 1000;

/// Follows runs and shows how far they are.
pub struct Progress {
    plan: Arc<Plan>,
    bar: ProgressBar,
    counts: Mutex<Counts>,
}

#[derive(Default)]
struct Counts {
    found: u64,
    finished: u64,
    /// Shots so far of each run that is under way.
    shots: BTreeMap<usize, u64>,
    /// Shots of the last run finished of each problem: what its next run is expected to take.
    expected: BTreeMap<usize, u64>,
}

impl Progress {
    /// A bar for a plan's runs; indicatif hides it where standard error is no terminal.
    pub fn new(plan: Arc<Plan>) -> Progress {
        let bar = ProgressBar::new(plan.runs.len() as u64 * STEPS);
        let style = ProgressStyle::with_template("{bar:36} {msg}, {elapsed} gone, {eta} left");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        Progress { plan, bar, counts: Mutex::default() }
    }

    /// Takes note of an event.
    pub fn note(&self, event: Event) {
        let mut counts = self.counts.lock().unwrap_or_else(PoisonError::into_inner);
        match event {
            Event::Found => counts.found += 1,
            Event::Shot { run } => *counts.shots.entry(run).or_default() += 1,
            Event::Finished { run } => {
                let shots = counts.shots.remove(&run).unwrap_or_default();
                counts.expected.insert(self.plan.runs[run].problem, shots);
                counts.finished += 1;
            }
        }
        // Shots come by the thousand: one in sixteen is enough to be shown.
        if let Event::Shot { run } = event
            && counts.shots.get(&run).is_some_and(|shots| shots % 16 != 0)
        {
            return;
        }
        self.show(&counts);
    }

    /// Takes the bar away.
    pub fn end(&self) {
        self.bar.finish_and_clear();
    }

    fn show(&self, counts: &Counts) {
        let under_way = counts.shots.iter().map(|(run, &shots)| {
            let expected = counts.expected.get(&self.plan.runs[*run].problem);
            // What no run of its problem has told yet is not guessed at.
            expected.map_or(0, |&expected| (STEPS * shots / expected.max(1)).min(STEPS * 9 / 10))
        });
        let ended = counts.found + counts.finished;
        self.bar.set_position(ended * STEPS + under_way.sum::<u64>());
        let shots: u64 = counts.shots.values().sum();
        let runs = self.plan.runs.len();
        self.bar.set_message(format!("{ended} of {runs} runs, {shots} shots in this one"));
    }
}
