//! Progress of an experiment on standard error: on a terminal a bar and a line for each run under way, else
//! a line every few seconds.

use std::collections::BTreeMap;
use std::io::IsTerminal;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressStyle};
use lab::{Counters, Event, Plan};

use crate::exit::print_note;

/// Steps of the bar per run.
const STEPS: u64 = 1000;

/// Seconds between lines where there is no bar; short experiments print none.
const BETWEEN_LINES: u64 = 5;

/// The most runs under way that get a line each.
const MOST_LINES: usize = 8;

/// Characters for the name of a run, so that lines fit 80 columns.
const NAME: usize = 30;

pub struct Progress {
    plan: Arc<Plan>,
    bar: ProgressBar,
    /// Whether lines are printed, since there is no terminal for a bar.
    lines: bool,
    counts: Mutex<Counts>,
}

#[derive(Default)]
struct Counts {
    found: u64,
    finished: u64,
    /// The number of lines that could have been printed so far.
    lines: u64,
    /// Shots so far of each run that is under way.
    shots: BTreeMap<usize, u64>,
    /// The state of each run that is under way.
    counters: BTreeMap<usize, Counters>,
    /// Shots of the last finished run of each problem: an estimate for its next run.
    expected: BTreeMap<usize, u64>,
}

impl Progress {
    /// The progress of a plan's runs; shows nothing if `quiet`.
    pub fn new(plan: Arc<Plan>, quiet: bool) -> Progress {
        let steps = plan.runs.len() as u64 * STEPS;
        let bar = ProgressBar::with_draw_target(Some(steps), target(quiet));
        let style = ProgressStyle::with_template("{bar:36} {prefix}, {elapsed} elapsed{msg}");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        if !bar.is_hidden() {
            bar.enable_steady_tick(Duration::from_secs(1));
        }
        bar.set_prefix(format!("0 of {} runs", plan.runs.len()));
        let lines = !quiet && !std::io::stderr().is_terminal();
        Progress { plan, bar, lines, counts: Mutex::default() }
    }

    /// Whether it shows the state of runs under way.
    pub fn shows_counters(&self) -> bool {
        !self.bar.is_hidden()
    }

    pub fn update(&self, event: Event) {
        let mut counts = self.counts.lock().unwrap_or_else(PoisonError::into_inner);
        match event {
            Event::Found => counts.found += 1,
            Event::Shots { run, shots } => _ = counts.shots.insert(run, shots),
            Event::Counters { run, counters } => _ = counts.counters.insert(run, counters),
            Event::Finished { run } => {
                counts.counters.remove(&run);
                let shots = counts.shots.remove(&run).unwrap_or_default();
                counts.expected.insert(self.plan.runs[run].problem, shots);
                counts.finished += 1;
            }
        }
        self.show(&mut counts);
    }

    pub fn end(&self) {
        self.bar.finish_and_clear();
    }

    fn show(&self, counts: &mut Counts) {
        let under_way = counts.shots.iter().map(|(run, &shots)| {
            let expected = counts.expected.get(&self.plan.runs[*run].problem);
            // Without a finished run of its problem there is no estimate.
            expected.map_or(0, |&expected| (STEPS * shots / expected.max(1)).min(STEPS * 9 / 10))
        });
        let ended = counts.found + counts.finished;
        self.bar.set_position(ended * STEPS + under_way.sum::<u64>());
        let shots: u64 = counts.shots.values().sum();
        let runs = self.plan.runs.len();
        let message = format!("{ended} of {runs} runs");
        // There is no estimate before something is done.
        let left = (self.bar.position() > 0).then(|| HumanDuration(self.bar.eta()));
        let due = self.bar.elapsed().as_secs() / BETWEEN_LINES;
        if self.lines && due > counts.lines {
            counts.lines = due;
            let elapsed = HumanDuration(self.bar.elapsed());
            let left = left.as_ref().map_or(String::new(), |left| format!(", {left} left"));
            print_note(&format!(
                "{message}, {shots} shots in those under way, {elapsed} elapsed{left}"
            ));
        }
        self.bar.set_prefix(message);
        let left = left.map_or(String::new(), |left| format!(", {left:#} left"));
        self.bar.set_message(left + &self.under_way(&counts.counters));
    }

    fn under_way(&self, counters: &BTreeMap<usize, Counters>) -> String {
        let mut table = String::new();
        if !counters.is_empty() {
            table +=
                &row("", ["time, s", "shots", "messages", "busy", "unshot"].map(str::to_owned));
        }
        for (&run, counters) in counters.iter().take(MOST_LINES) {
            let mut name = self.plan.label(&self.plan.runs[run]);
            if name.chars().count() > NAME {
                name = name.chars().take(NAME - 1).chain(['…']).collect();
            }
            let busy = format!("{}/{}", counters.busy, counters.nodes);
            let unshot = format!("{:.1} %", 100.0 * counters.unshot);
            let time = format!("{:.2}", counters.time_s);
            let counts = [counters.shots, counters.messages].map(|count| count.to_string());
            let [shots, messages] = counts;
            table += &row(&name, [time, shots, messages, busy, unshot]);
        }
        if counters.len() > MOST_LINES {
            table += &format!("\nand {} more", counters.len() - MOST_LINES);
        }
        table
    }
}

/// Where bars are drawn.
fn target(quiet: bool) -> ProgressDrawTarget {
    if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() }
}

fn row(name: &str, cells: [String; 5]) -> String {
    let [time, shots, messages, busy, unshot] = cells;
    format!("\n{name:NAME$} {time:>10} {shots:>8} {messages:>9} {busy:>9} {unshot:>8}")
}

/// Progress of pilot runs, which find settings. Their number is not known in advance.
pub struct Pilots(ProgressBar);

impl Pilots {
    /// Shows nothing if `quiet`.
    pub fn new(quiet: bool) -> Pilots {
        Pilots(ProgressBar::with_draw_target(None, target(quiet)))
    }

    /// A pilot run has ended.
    pub fn update(&self, scene: &str, target: f64, runs: usize) {
        let percent = 100.0 * target;
        self.0.set_message(format!("settings for {scene} to {percent} %: {runs} pilot runs"));
        self.0.tick();
    }

    pub fn end(&self) {
        self.0.finish_and_clear();
    }
}
