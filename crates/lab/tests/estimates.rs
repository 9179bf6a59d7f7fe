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
                patches: number(words[5]),
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

/// By what factor the estimates from this share of a sweep on are off, the greatest first; the last few seconds
/// or parts of them do not count. None for a missing estimate.
fn factors(text: &str, from: f64, seconds: f64) -> Vec<f64> {
    let estimates = replayed(text);
    let end = estimates[0].1;
    let counted = estimates.iter().filter(|(at, left, _)| *at >= from * end && *left > seconds);
    let mut factors: Vec<f64> = counted
        .map(|(_, left, estimate)| match estimate {
            Some(estimate) => (estimate.likely / left).max(left / estimate.likely),
            None => f64::INFINITY,
        })
        .collect();
    factors.sort_by(|a, b| b.total_cmp(a));
    factors
}

const RECORDED: [(&str, &str); 4] = [
    ("table1", include_str!("recorded/table1.txt")),
    ("message-layers", include_str!("recorded/message-layers.txt")),
    ("networks", include_str!("recorded/networks.txt")),
    ("paging-sizes", include_str!("recorded/paging-sizes.txt")),
];

/// One run under way and two that wait; half of the power of the first has been shot.
fn half_of_the_first(reuses: bool, power: f64) -> Option<Left> {
    let known = Known { problem: 0, machine: 0, processors: 1, reuses, patches: 10 };
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
    let likely = |reuses| half_of_the_first(reuses, 0.5).unwrap().likely;
    assert!((likely(true) - (1.0 + 0.4 + 0.4)).abs() < 1e-9);
    assert!((likely(false) - (1.0 + 2.0 + 2.0)).abs() < 1e-9);
}

/// When all lights are shot, nothing tells how much reflected light will be.
#[test]
fn there_is_no_estimate_without_a_hint() {
    assert_eq!(half_of_the_first(true, 1.0), None);
    assert_eq!(half_of_the_first(true, 0.001), None);
    let mut nothing = Estimator::new([], 0);
    assert_eq!(nothing.left(1.0).map(|left| left.most), Some(0.0));
    nothing.note(1.0, Event::Counters { run: 0, counters: Counters::default() });
}

/// A problem of which nothing is known makes an estimate a range; what a found run cost is unknown.
#[test]
fn other_problems_make_it_unsure() {
    let known = |problem| Known { problem, machine: 0, processors: 1, reuses: true, patches: 10 };
    let mut estimator = Estimator::new([known(0), known(1), known(0)], 1);
    estimator.note(0.0, Event::Found { run: 2 });
    estimator.note(0.0, Event::Started { run: 0 });
    let done = Done { shots: 100, power: 1.0, new: 100, waited_s: 0.8 };
    estimator.note(1.0, Event::Finished { run: 0, done });
    let left = estimator.left(1.0).unwrap();
    assert!((left.likely - 1.0).abs() < 1e-9);
    assert_eq!((left.least, left.most), (0.25, 4.0));
    estimator.note(1.0, Event::Started { run: 1 });
    estimator.note(1.5, Event::Shots { run: 1, done: Done { shots: 50, power: 0.5, new: 50, waited_s: 0.4 } });
    let left = estimator.left(1.5).unwrap();
    assert!((left.likely - 0.5).abs() < 1e-9 && left.most / left.least < 1.5, "{left:?}");
}

#[test]
fn estimates_of_recorded_sweeps_are_within_a_factor_of_one_and_a_half() {
    for (name, text) in RECORDED {
        for (from, seconds) in [(0.05, 0.0), (0.25, 0.0), (0.25, 1.0)] {
            let factors = factors(text, from, seconds);
            let at = |share: f64| factors[(factors.len() as f64 * share) as usize];
            println!("{name} from {from}, {seconds} s: greatest {:.2}, 5 % {:.2}, half {:.2}", factors[0], at(0.05), at(0.5));
        }
        if std::env::var_os("ALL").is_some() {
            for (at, left, estimate) in replayed(text).iter().step_by(4) {
                println!("  {at:.2} {left:.2} {estimate:.2?}");
            }
        }
    }
}
