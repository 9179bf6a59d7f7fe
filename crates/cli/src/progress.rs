//! Progress of an experiment on standard error: on a terminal a bar and a line for each run under way, else
//! a line every few seconds.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{IsTerminal, Write};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressStyle};
use lab::{Counters, Estimator, Event, Left, Plan, event_log};

use crate::exit::print_note;

/// Steps of the bar per run.
const STEPS: u64 = 1000;

/// Estimates whose ends differ by a larger factor are not shown, by a smaller one as one number.
const VAGUE: f64 = 10.0;
const CLEAR: f64 = 2.0;

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

struct Counts {
    found: u64,
    finished: u64,
    /// The number of lines that could have been printed so far.
    lines: u64,
    /// Shots so far of each run that is under way.
    shots: BTreeMap<usize, u64>,
    /// The state of each run that is under way.
    counters: BTreeMap<usize, Counters>,
    estimator: Estimator,
    /// The last estimate, and the second in which the next one is due.
    left: Option<Left>,
    next: f64,
    /// Where events are recorded.
    log: Option<File>,
}

impl Progress {
    /// The progress of a plan's runs on `threads` threads; shows nothing if `quiet`. Events go to a log, if any.
    pub fn new(plan: Arc<Plan>, threads: usize, quiet: bool, log: Option<File>) -> Progress {
        let steps = plan.runs.len() as u64 * STEPS;
        let bar = ProgressBar::with_draw_target(Some(steps), target(quiet));
        let style = ProgressStyle::with_template("{bar:36} {prefix}, {elapsed} elapsed{msg}");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        if !bar.is_hidden() {
            bar.enable_steady_tick(Duration::from_secs(1));
        }
        bar.set_prefix(format!("0 of {} runs", plan.runs.len()));
        let lines = !quiet && !std::io::stderr().is_terminal();
        let counts = Counts {
            found: 0,
            finished: 0,
            lines: 0,
            shots: BTreeMap::new(),
            counters: BTreeMap::new(),
            estimator: Estimator::of(&plan, threads),
            left: None,
            next: 0.0,
            log,
        };
        Progress { plan, bar, lines, counts: Mutex::new(counts) }
    }

    /// Whether it shows the state of runs under way.
    pub fn shows_counters(&self) -> bool {
        !self.bar.is_hidden()
    }

    pub fn update(&self, event: Event) {
        let mut counts = self.counts.lock().unwrap_or_else(PoisonError::into_inner);
        let elapsed = self.bar.elapsed().as_secs_f64();
        counts.estimator.note(elapsed, event);
        if let (Some(log), Some(line)) = (&mut counts.log, event_log::line(elapsed, event)) {
            // A log that cannot be written is no reason to end the sweep.
            let _ = log.write_all(line.as_bytes());
        }
        match event {
            Event::Found { .. } => counts.found += 1,
            Event::Started { run } => _ = counts.shots.insert(run, 0),
            Event::Shots { run, done } => _ = counts.shots.insert(run, done.shots),
            Event::Counters { run, counters } => _ = counts.counters.insert(run, counters),
            Event::Finished { run, .. } => {
                counts.counters.remove(&run);
                counts.shots.remove(&run);
                counts.finished += 1;
            }
        }
        self.show(&mut counts);
    }

    pub fn end(&self) {
        self.bar.finish_and_clear();
    }

    fn show(&self, counts: &mut Counts) {
        let ended = counts.found + counts.finished;
        let shots: u64 = counts.shots.values().sum();
        let runs = self.plan.runs.len();
        let message = format!("{ended} of {runs} runs");
        let elapsed = self.bar.elapsed().as_secs_f64();
        if elapsed >= counts.next {
            (counts.left, counts.next) = (counts.estimator.left(elapsed), elapsed + 1.0);
        }
        let share = match counts.left {
            Some(Left { likely, .. }) => elapsed / (elapsed + likely).max(f64::MIN_POSITIVE),
            None => ended as f64 / runs as f64,
        };
        self.bar.set_position((share * (runs as u64 * STEPS) as f64) as u64);
        let left =
            counts.left.and_then(in_words).map_or(String::new(), |left| format!(", {left} left"));
        let due = self.bar.elapsed().as_secs() / BETWEEN_LINES;
        if self.lines && due > counts.lines {
            counts.lines = due;
            let elapsed = HumanDuration(self.bar.elapsed());
            print_note(&format!(
                "{message}, {shots} shots in those under way, {elapsed} elapsed{left}"
            ));
        }
        self.bar.set_prefix(message);
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

/// An estimate in words: a range while it is unsure, nothing while it is vague.
fn in_words(left: Left) -> Option<String> {
    let words = |seconds: f64| HumanDuration(Duration::from_secs_f64(seconds.clamp(0.0, 1e9)));
    let Left { least, likely, most } = left;
    match most / least {
        factor if factor <= CLEAR => Some(format!("about {}", words(likely))),
        factor if factor <= VAGUE => Some(format!("{} to {}", words(least), words(most))),
        _ => None,
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
