//! Events of a sweep with their times as lines of text, to be replayed to the estimator in tests.

use std::fmt::Write as _;

use crate::planning::plan::Plan;
use crate::run::estimate::Known;
use crate::run::runner::Event;
use crate::run::shot_sum::Done;

/// The lines of a plan: its threads, and each run as `run PROBLEM MACHINE PROCESSORS REUSES
/// LIGHTS_ONLY PATCHES`.
pub fn head(plan: &Plan, threads: usize) -> String {
    let mut text = format!("threads {threads}\n");
    for run in &plan.runs {
        let Known { problem, machine, processors, reuses, lights_only, patches } =
            Known::of(plan, run);
        // Writing to a string cannot fail.
        let _ =
            writeln!(text, "run {problem} {machine} {processors} {reuses} {lights_only} {patches}");
    }
    text
}

/// The line of an event, after `seconds`; none of those that estimates do not need.
pub fn line(seconds: f64, event: Event) -> Option<String> {
    let of = |kind, run, Done { shots, power, new, waited_s }| {
        format!("{kind} {seconds:.3} {run} {shots} {power:.4} {new} {waited_s:.4}\n")
    };
    match event {
        Event::Started { run } => Some(of("started", run, Done::default())),
        Event::Shots { run, done } => Some(of("shots", run, done)),
        Event::Finished { run, done } => Some(of("finished", run, done)),
        Event::Found { run } => Some(of("found", run, Done::default())),
        Event::Counters { .. } => None,
    }
}
