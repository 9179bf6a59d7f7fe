//! How far an experiment is, on standard error: on a terminal a bar, and the runs under way in a line each;
//! else a line now and then.

use std::collections::BTreeMap;
use std::io::IsTerminal;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressStyle};
use lab::{Event, Plan, Pulse};

use crate::exit::note;

/// Steps of the bar for a run.
const STEPS: u64 = 1000;

/// Seconds between lines where there is no bar: short runs leave none in a log.
const BETWEEN_LINES: u64 = 5;

/// The most runs under way that get a line each.
const MOST_LINES: usize = 8;

/// Characters for the name of a run: lines have to fit 80.
const NAME: usize = 30;

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
    /// How each run is that is under way.
    pulses: BTreeMap<usize, Pulse>,
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
        let style = ProgressStyle::with_template("{bar:36} {prefix}, {elapsed} gone{msg}");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        if !bar.is_hidden() {
            bar.enable_steady_tick(Duration::from_secs(1));
        }
        bar.set_prefix(format!("0 of {} runs", plan.runs.len()));
        let lines = !quiet && !std::io::stderr().is_terminal();
        Progress { plan, bar, lines, counts: Mutex::default() }
    }

    /// Whether it shows how runs are.
    pub fn shows_pulse(&self) -> bool {
        !self.bar.is_hidden()
    }

    /// Takes note of an event.
    pub fn note(&self, event: Event) {
        let mut counts = self.counts.lock().unwrap_or_else(PoisonError::into_inner);
        match event {
            Event::Found => counts.found += 1,
            Event::Shots { run, shots } => _ = counts.shots.insert(run, shots),
            Event::Pulse { run, pulse } => _ = counts.pulses.insert(run, pulse),
            Event::Finished { run } => {
                counts.pulses.remove(&run);
                let shots = counts.shots.remove(&run).unwrap_or_default();
                counts.expected.insert(self.plan.runs[run].problem, shots);
                counts.finished += 1;
            }
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
        let message = format!("{ended} of {runs} runs");
        // Nobody knows before something has been done.
        let left = (self.bar.position() > 0).then(|| HumanDuration(self.bar.eta()));
        let times_up = self.bar.elapsed().as_secs() / BETWEEN_LINES;
        if self.lines && times_up > counts.lines {
            counts.lines = times_up;
            let gone = HumanDuration(self.bar.elapsed());
            let left = left.as_ref().map_or(String::new(), |left| format!(", {left} left"));
            note(&format!("{message}, {shots} shots in this one, {gone} gone{left}"));
        }
        self.bar.set_prefix(message);
        let left = left.map_or(String::new(), |left| format!(", {left:#} left"));
        self.bar.set_message(left + &self.under_way(&counts.pulses));
    }

    /// The runs under way, as a table.
    fn under_way(&self, pulses: &BTreeMap<usize, Pulse>) -> String {
        let mut table = String::new();
        if !pulses.is_empty() {
            table +=
                &row("", ["time, s", "shots", "messages", "busy", "unshot"].map(str::to_owned));
        }
        for (&run, pulse) in pulses.iter().take(MOST_LINES) {
            let mut name = self.plan.label(&self.plan.runs[run]);
            if name.chars().count() > NAME {
                name = name.chars().take(NAME - 1).chain(['…']).collect();
            }
            let busy = format!("{}/{}", pulse.busy, pulse.nodes);
            let unshot = format!("{:.1} %", 100.0 * pulse.unshot);
            let time = format!("{:.2}", pulse.time_s);
            let counts = [pulse.shots, pulse.messages].map(|count| count.to_string());
            let [shots, messages] = counts;
            table += &row(&name, [time, shots, messages, busy, unshot]);
        }
        if pulses.len() > MOST_LINES {
            table += &format!("\nand {} more", pulses.len() - MOST_LINES);
        }
        table
    }
}

/// A line below the bar.
fn row(name: &str, cells: [String; 5]) -> String {
    let [time, shots, messages, busy, unshot] = cells;
    format!("\n{name:NAME$} {time:>10} {shots:>8} {messages:>9} {busy:>9} {unshot:>8}")
}

/// Follows pilot runs, which find settings: nobody knows how many there will be.
pub struct Pilots(ProgressBar);

impl Pilots {
    /// To be shown unless `quiet`; indicatif hides it where standard error is no terminal.
    pub fn new(quiet: bool) -> Pilots {
        let target =
            if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
        Pilots(ProgressBar::with_draw_target(None, target))
    }

    /// A pilot run has ended.
    pub fn note(&self, scene: &str, target: f64, runs: usize) {
        let percent = 100.0 * target;
        self.0.set_message(format!("settings for {scene} to {percent} %: {runs} pilot runs"));
        self.0.tick();
    }

    /// Takes it away.
    pub fn end(&self) {
        self.0.finish_and_clear();
    }
}
