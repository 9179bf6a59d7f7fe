//! How far an experiment is, on standard error: a bar on a terminal, else a line now and then.

use std::collections::BTreeMap;
use std::io::IsTerminal;
use std::sync::{Arc, Mutex, PoisonError};

use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressStyle};
use lab::{Event, Plan};

use crate::exit::note;

/// Steps of the bar for a run.
const STEPS: u64 = 1000;

/// Seconds between lines where there is no bar: short runs leave none in a log.
const BETWEEN_LINES: u64 = 5;

/// Follows runs and shows how far they are.
pub struct Progress {
    plan: Arc<Plan>,
    bar: ProgressBar,
    /// Whether lines are written: there is no terminal for a bar.
    lines: bool,
    counts: Mutex<Counts>,
}

#[derive(Default)]
struct Counts {
    found: u64,
    finished: u64,
    /// Lines so far, or for how many there was time.
    lines: u64,
    /// Shots so far of each run that is under way.
    shots: BTreeMap<usize, u64>,
    /// Shots of the last run finished of each problem: what its next run is expected to take.
    expected: BTreeMap<usize, u64>,
}

impl Progress {
    /// Of a plan's runs, to be shown unless `quiet`.
    pub fn new(plan: Arc<Plan>, quiet: bool) -> Progress {
        let steps = plan.runs.len() as u64 * STEPS;
        let target =
            if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
        let bar = ProgressBar::with_draw_target(Some(steps), target);
        let style = ProgressStyle::with_template("{bar:36} {msg}, {elapsed} gone, {eta} left");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        let lines = !quiet && !std::io::stderr().is_terminal();
        Progress { plan, bar, lines, counts: Mutex::default() }
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
        self.show(&mut counts);
    }

    /// Takes the bar away.
    pub fn end(&self) {
        self.bar.finish_and_clear();
    }

    fn show(&self, counts: &mut Counts) {
        let under_way = counts.shots.iter().map(|(run, &shots)| {
            let expected = counts.expected.get(&self.plan.runs[*run].problem);
            // What no run of its problem has told yet is not guessed at.
            expected.map_or(0, |&expected| (STEPS * shots / expected.max(1)).min(STEPS * 9 / 10))
        });
        let ended = counts.found + counts.finished;
        self.bar.set_position(ended * STEPS + under_way.sum::<u64>());
        let shots: u64 = counts.shots.values().sum();
        let runs = self.plan.runs.len();
        let message = format!("{ended} of {runs} runs, {shots} shots in this one");
        let times_up = self.bar.elapsed().as_secs() / BETWEEN_LINES;
        if self.lines && times_up > counts.lines {
            counts.lines = times_up;
            let [gone, left] = [self.bar.elapsed(), self.bar.eta()].map(HumanDuration);
            note(&format!("{message}, {gone} gone, {left} left"));
        }
        self.bar.set_message(message);
    }
}
