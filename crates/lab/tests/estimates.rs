//! Estimates of what is left, on recorded events of shipped experiments (`virtwall run NAME --log-events FILE`,
//! events of shots thinned out).

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::str::FromStr;

use lab::{Counters, Done, Estimator, Event, Known, Left};

/// The estimates of a recorded sweep, each with the seconds that were left.
fn replayed(text: &str) -> Vec<(f64, f64, Option<Left>)> {
    let mut runs = Vec::new();
    let (mut threads, mut events) = (1, Vec::new());
    for line in text.lines() {
        let words: Vec<&str> = line.split(' ').collect();
        match words[0] {
            "threads" => threads = number(words[1]),
            "run" => runs.push(Known {
                problem: number(words[1]),
                machine: number(words[2]),
                processors: number(words[3]),
                reuses: number(words[4]),
                lights_only: number(words[5]),
                patches: number(words[6]),
            }),
            kind => events.push((number::<f64>(words[1]), event(kind, &words))),
        }
    }
    let mut estimator = Estimator::new(runs, threads);
    let end = events.last().unwrap().0;
    let (mut estimates, mut next) = (Vec::new(), 0.0);
    for (seconds, event) in events {
        // At two hundred times, as far as there are events.
        while next < seconds {
            estimates.push((next, end - next, estimator.left(next)));
            next += end / 200.0;
        }
        estimator.note(seconds, event);
    }
    estimates
}

fn number<T: FromStr<Err: std::fmt::Debug>>(word: &str) -> T {
    word.parse().unwrap()
}

fn event(kind: &str, words: &[&str]) -> Event {
    let run = number(words[2]);
    let [power, waited_s] = [4, 6].map(|index| number(words[index]));
    let done = Done { shots: number(words[3]), power, new: number(words[5]), waited_s };
    match kind {
        "started" => Event::Started { run },
        "shots" => Event::Shots { run, done },
        "finished" => Event::Finished { run, done },
        _ => Event::Found { run },
    }
}

/// By what factors the estimates in the last three quarters of a sweep are off, each with the seconds left.
fn factors(text: &str) -> Vec<(f64, f64)> {
    let estimates = replayed(text);
    let end = estimates[0].1;
    let counted = estimates.iter().filter(|(at, ..)| *at >= 0.25 * end);
    let factor = |left: f64, estimate: Option<Left>| match estimate {
        Some(estimate) => (estimate.likely / left).max(left / estimate.likely),
        None => f64::INFINITY,
    };
    counted.map(|(_, left, estimate)| (factor(*left, *estimate), *left)).collect()
}

/// Sweeps recorded on a host with other work, and how many percent of the estimates in the last three quarters are
/// within a factor of 1.5. In Table 1, Office, the last of three problems, turns out to be cheap.
const RECORDED: [(&str, &str, f64); 4] = [
    ("table1", include_str!("recorded/table1.txt"), 65.0),
    ("message-layers", include_str!("recorded/message-layers.txt"), 85.0),
    ("networks", include_str!("recorded/networks.txt"), 90.0),
    ("paging-sizes", include_str!("recorded/paging-sizes.txt"), 90.0),
];

/// One run under way and two that wait; half of the power of the first has been shot.
fn half_of_the_first(reuses: bool, lights_only: bool, power: f64) -> Option<Left> {
    let known = Known { problem: 0, machine: 0, processors: 1, reuses, lights_only, patches: 10 };
    let mut estimator = Estimator::new([known; 3], 1);
    assert_eq!(estimator.left(0.0), None);
    estimator.note(0.0, Event::Started { run: 0 });
    assert_eq!(estimator.left(0.5), None);
    let done = Done { shots: 100, power, new: 100, waited_s: 0.8 };
    estimator.note(1.0, Event::Shots { run: 0, done });
    estimator.left(1.0)
}

/// 100 shots took 0.2 s to simulate and 0.8 s to cast.
#[test]
fn shots_in_memory_cost_their_simulation_only() {
    let likely = |reuses| half_of_the_first(reuses, true, 0.5).unwrap().likely;
    assert!((likely(true) - (1.0 + 0.4 + 0.4)).abs() < 1e-9);
    assert!((likely(false) - (1.0 + 2.0 + 2.0)).abs() < 1e-9);
}

/// Nothing tells how much reflected light a first run will shoot.
#[test]
fn there_is_no_estimate_without_a_hint() {
    assert_eq!(half_of_the_first(true, false, 0.5), None);
    assert_eq!(half_of_the_first(true, true, 0.001), None);
    // When all lights are shot, it is about to end: two runs are left.
    let left = half_of_the_first(true, true, 1.0).unwrap();
    assert!((left.likely - 0.4).abs() < 1e-9);
    let mut nothing = Estimator::new([], 0);
    assert_eq!(nothing.left(1.0).map(|left| left.most), Some(0.0));
    nothing.note(1.0, Event::Counters { run: 0, counters: Counters::default() });
}

/// A problem of which nothing is known makes an estimate a range; what a found run cost is unknown.
#[test]
fn other_problems_make_it_unsure() {
    let known = |problem| Known {
        problem,
        machine: 0,
        processors: 1,
        reuses: true,
        lights_only: true,
        patches: 10,
    };
    let mut estimator = Estimator::new([known(0), known(1), known(0)], 1);
    estimator.note(0.0, Event::Found { run: 2 });
    estimator.note(0.0, Event::Started { run: 0 });
    let done = Done { shots: 100, power: 1.0, new: 100, waited_s: 0.8 };
    estimator.note(1.0, Event::Finished { run: 0, done });
    let left = estimator.left(1.0).unwrap();
    assert!((left.likely - 1.0).abs() < 1e-9);
    assert!((left.least - 0.25).abs() < 1e-9 && (left.most - 4.0).abs() < 1e-9, "{left:?}");
    estimator.note(1.0, Event::Started { run: 1 });
    estimator.note(
        1.5,
        Event::Shots { run: 1, done: Done { shots: 50, power: 0.5, new: 50, waited_s: 0.4 } },
    );
    let left = estimator.left(1.5).unwrap();
    assert!((left.likely - 0.5).abs() < 1e-9 && left.most / left.least < 1.5, "{left:?}");
}

#[test]
fn estimates_of_recorded_sweeps_are_near() {
    for (name, text, expected) in RECORDED {
        let factors = factors(text);
        let near = factors.iter().filter(|(factor, _)| *factor <= 1.5).count();
        let percent = 100.0 * near as f64 / factors.len() as f64;
        let long = factors.iter().filter(|(_, left)| *left > 1.0);
        let most = long.map(|(factor, _)| *factor).fold(1.0, f64::max);
        println!(
            "{name}: {percent:.0} % within 1.5; {most:.2} at most with more than a second left"
        );
        assert!(percent >= expected && most <= 2.5, "{name}: {percent} %, {most}");
    }
}
