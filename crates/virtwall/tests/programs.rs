//! The programs as a whole: on the simulated Paragon and on threads.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use common::{grey, paragon, problem, rules, same, scene, sides, two_rooms_cut};
use desim::{Duration, Time};
use multicomputer::{ContentionFree, Delivery, Formula, Ideal, Machine, Message};
use virtwall::{
    Ending, KeptShots, Outcome, Problem, ProgramError, Rules, Run, RunError, Shooting, Source,
    SourceSplit, most_shots_in_sequence, run_on_threads, simulate, simulate_observed,
};

fn run(problem: &Arc<Problem>, processors: usize, rules: Rules) -> Run {
    Run {
        problem: Arc::clone(problem),
        processors,
        rules,
        kept: Arc::new(KeptShots::new(1 << 30)),
        on_shot: Arc::new(|_| ()),
    }
}

/// Relative L2 difference of two radiosity solutions of the same problem.
fn difference(a: &Outcome, b: &Outcome) -> f64 {
    let pairs = a.radiosity.iter().flatten().zip(b.radiosity.iter().flatten());
    let (mut apart, mut size) = (0.0, 0.0);
    for (x, y) in pairs {
        apart += (*x - *y).length_squared();
        size += x.length_squared();
    }
    (apart / size).sqrt()
}

#[test]
fn energy_closes_on_any_number_of_processors() {
    let problem = two_rooms_cut([4, 2, 1]);
    for processors in [1, 2, 3, 8] {
        for merge_masks in [false, true] {
            let rules = Rules { merge_masks, ..rules() };
            let outcome = simulate(&run(&problem, processors, rules), &paragon()).unwrap();
            assert!(outcome.energy.error() < 1e-9, "{:?}", outcome.energy);
            assert_eq!(outcome.ending, Ending::Agreed);
            assert!(outcome.counts.local_shots > 20 && outcome.time > Time::ZERO);
            for node in &outcome.nodes {
                assert!(node.compute + node.overhead + node.idle <= outcome.time - Time::ZERO);
            }
        }
    }
}

/// A kept shot is the shot itself; and the same run twice is the same to the bit.
#[test]
fn keeping_shots_changes_nothing() {
    let problem = two_rooms_cut([2, 2, 2]);
    let shared = run(&problem, 4, rules());
    let outcomes = [1 << 30, 0, 20_000].map(|budget| {
        let run = Run { kept: Arc::new(KeptShots::new(budget)), ..shared.clone() };
        simulate(&run, &paragon()).unwrap()
    });
    let again = simulate(&shared, &paragon()).unwrap();
    for other in outcomes.iter().chain([&again]) {
        same(other, &outcomes[0]);
    }
}

/// §5.2: virtual interfaces do not change the light. With cut planes through no patch the meshes
/// are the same, and so must the radiosities be, within what the order of shots changes.
#[test]
fn threads_and_simulation_find_the_same_light() {
    let problem = two_rooms_cut([4, 2, 1]);
    let fine = Rules { patch_threshold: 1e-4, ..rules() };
    let simulated = simulate(&run(&problem, 4, fine.clone()), &paragon()).unwrap();
    let sequential = simulate(&run(&problem, 1, fine.clone()), &paragon()).unwrap();
    let threads = run_on_threads(&run(&problem, 4, fine)).unwrap();
    assert!(threads.energy.error() < 1e-9);
    // What stays below the threshold is unshot, in another patch each time.
    assert!(difference(&simulated, &sequential) < 2e-3, "{}", difference(&simulated, &sequential));
    if threads.ending == Ending::Agreed {
        assert!(difference(&simulated, &threads) < 2e-3, "{}", difference(&simulated, &threads));
    }
}

/// Nobody waits for a node whose thread panicked.
#[test]
fn a_thread_that_panics_ends_the_run() {
    let shots = AtomicU64::new(0);
    let on_shot =
        move |_: &Source| assert!(shots.fetch_add(1, Ordering::Relaxed) < 10, "as it should");
    let problem = two_rooms_cut([4, 2, 1]);
    let run = Run { on_shot: Arc::new(on_shot), ..run(&problem, 4, rules()) };
    assert!(matches!(run_on_threads(&run), Err(RunError::Thread)));
}

/// A global threshold stops selection through the service node.
#[test]
fn the_service_node_stops_selection() {
    let problem = two_rooms_cut([2, 2, 1]);
    let collect_every = Duration::from_seconds_f64(0.01);
    let rules = Rules { patch_threshold: 0.0, energy_threshold: 0.2, collect_every, ..rules() };
    let outcome = simulate(&run(&problem, 4, rules), &paragon()).unwrap();
    let left = outcome.energy.unshot.element_sum() / outcome.energy.emitted.element_sum();
    assert!(left < 0.2 && left > 0.01, "{left}");
    assert!(outcome.energy.error() < 1e-9);
}

/// A network with a lane of its own for short messages: long ones take this time, seconds.
struct SlowMasks(f64);

impl Formula for SlowMasks {
    fn deliver(&mut self, now: Time, message: &Message) -> Delivery {
        let span = Duration::from_seconds_f64(if message.bytes > 100 { self.0 } else { 1e-6 });
        Delivery { sender_free: now, arrives: now + span, stall: None }
    }

    fn receive_overhead(&self) -> Duration {
        Duration::ZERO
    }
}

/// When the token overtakes sources, the paper's rule ends the run too early; the run says so, with
/// the energy lost.
#[test]
fn a_premature_end_is_told() {
    let problem = two_rooms_cut([4, 2, 1]);
    let run = run(&problem, 8, rules());
    let outcome =
        simulate_observed(&run, &paragon(), Box::new(ContentionFree::new(SlowMasks(10.0))), None)
            .unwrap();
    let Ending::TooEarly { lost } = outcome.ending else { panic!("{:?}", outcome.ending) };
    assert!(lost > 0.0 && lost < 1.0, "{lost}");
    let in_transit = outcome.energy.in_transit.element_sum();
    assert!((in_transit / outcome.energy.emitted.element_sum() - lost).abs() < 1e-15);
    assert!(outcome.energy.error() < 1e-9);
}

/// Whatever nodes do when the end is announced too early, the run ends and its energy balances.
#[test]
fn a_premature_end_is_an_end_at_any_moment() {
    let problem = two_rooms_cut([4, 2, 1]);
    let split = SourceSplit { nearer_than: f64::INFINITY, most: 2 };
    let mut early = 0;
    for step in 0..30 {
        let seconds = 1e-6 * 1.5_f64.powi(step);
        for (processors, merge_masks, split) in
            [(8, false, SourceSplit::NONE), (3, true, split), (5, false, SourceSplit::NONE)]
        {
            let shooting = Shooting { split, overshoot: 1.2, ..Shooting::default() };
            let rules = Rules { merge_masks, shooting, patch_threshold: 0.01, ..rules() };
            let run = run(&problem, processors, rules);
            let network = Box::new(ContentionFree::new(SlowMasks(seconds)));
            let outcome = simulate_observed(&run, &paragon(), network, None).unwrap();
            early += u32::from(outcome.ending != Ending::Agreed);
        }
    }
    assert!((10..80).contains(&early), "{early}");
}

/// A threshold of 0 is off, also where over-shooting leaves negative power: how often the service node
/// collects changes nothing that matters.
#[test]
fn over_shooting_ends_by_the_threshold_of_patches() {
    let problem = two_rooms_cut([2, 1, 1]);
    let shots = [0.01, 0.1, 1e4].map(|seconds| {
        let collect_every = Duration::from_seconds_f64(seconds);
        let shooting = Shooting { overshoot: 1.8, ..Shooting::default() };
        let rules = Rules { collect_every, shooting, patch_threshold: 1e-3, ..rules() };
        let outcome = simulate(&run(&problem, 1, rules), &paragon()).unwrap();
        (outcome.counts.local_shots, outcome.energy.absorbed)
    });
    assert_eq!(shots[0], shots[2]);
    assert_eq!(shots[1], shots[2]);
}

/// The period of collection moves a run only by the time of its messages and of the search for a source that
/// follows each: where these take none, runs are the same to the bit with any period. On one processor the light is
/// the same also where they take time.
#[test]
fn the_period_of_collection_moves_a_run_only_by_what_its_messages_cost() {
    let problem = two_rooms_cut([4, 2, 1]);
    let shooting = Shooting { overshoot: 1.5, ..Shooting::default() };
    let mut free = paragon();
    for search in ["patch_scan", "queue_scan"] {
        *free.processor.cycles.get_mut(search).unwrap() = 0.0;
    }
    let outcome = |processors, machine: &Machine, ideal, seconds| {
        let collect_every = Duration::from_seconds_f64(seconds);
        let rules = Rules { collect_every, shooting, patch_threshold: 1e-3, ..rules() };
        let network = if ideal { Box::new(ContentionFree::new(Ideal)) } else { machine.network() };
        let run = run(&problem, processors, rules);
        let Outcome { time, counts, energy, radiosity, .. } =
            simulate_observed(&run, machine, network, None).unwrap();
        (time, (counts.local_shots, counts.received_shots, energy, radiosity))
    };
    for processors in [1, 3, 8] {
        let once = outcome(processors, &free, true, 1e4);
        assert_eq!(outcome(processors, &free, true, 1e-3), once);
        assert_eq!(outcome(processors, &free, true, 0.07), once);
    }
    let [often, once] = [1e-3, 1e4].map(|seconds| outcome(1, &paragon(), false, seconds));
    assert!(often.0 > once.0);
    assert_eq!(often.1, once.1);
}

/// Light that does not fall ends the run with an error, on both back ends.
#[test]
fn no_progress_ends_the_run() {
    let problem = two_rooms_cut([2, 1, 1]);
    let shooting = Shooting { overshoot: 6.0, ..Shooting::default() };
    let rules = Rules { shooting, shots_without_progress: Some(2_000), ..rules() };
    let run = run(&problem, 2, rules);
    for ended in [simulate(&run, &paragon()), run_on_threads(&run)] {
        let Err(RunError::Program(ProgramError::NoProgress(error))) = ended else {
            panic!("{ended:?}");
        };
        assert_eq!((error.window, error.shots % 2_000), (2_000, 0));
        let falls = error.now < error.most * error.before;
        assert!(!falls, "{error}");
    }
}

/// Processors with little to do shoot the least light that arrives, while others fall behind: their shots grow
/// without bound as the threshold falls, and the run says so.
#[test]
fn shots_that_grow_without_bound_end_the_run() {
    let problem = two_rooms_cut([2, 2, 2]);
    let outcome = |processors, patch_threshold| {
        simulate(&run(&problem, processors, Rules { patch_threshold, ..rules() }), &paragon())
    };
    let fine = outcome(1, 1e-11).unwrap();
    let most = most_shots_in_sequence(&problem, &Rules { patch_threshold: 1e-11, ..rules() });
    assert!((fine.counts.local_shots as f64) < most.unwrap(), "{most:?}");
    let error = outcome(3, 1e-25).unwrap_err();
    assert!(matches!(error, RunError::Program(ProgramError::NoProgress(_))), "{error}");
}

/// A processor that takes longer than virtual time lasts.
#[test]
fn virtual_time_that_is_over_ends_the_run() {
    let problem = two_rooms_cut([2, 1, 1]);
    for cycles in [1e300, f64::INFINITY, f64::NAN] {
        let mut machine = paragon();
        *machine.processor.cycles.get_mut("ray").unwrap() = cycles;
        let error = simulate(&run(&problem, 2, rules()), &machine).unwrap_err();
        assert!(error.to_string().contains("virtual time"), "{error}");
    }
}

#[test]
fn no_light_ends_at_once() {
    let dark = scene(&sides([0.0; 3], [4.0; 3], [0; 6], true), vec![grey(0.5, 0.0)]);
    let problem = Arc::new(problem(dark, [4, 4, 4], [2, 2, 1], 64, 1.0));
    let outcome = simulate(&run(&problem, 4, rules()), &paragon()).unwrap();
    assert_eq!((outcome.counts.local_shots, outcome.energy.error()), (0, 0.0));
    assert_eq!(outcome.ending, Ending::Agreed);
}

#[test]
fn impossible_numbers_of_processors_are_refused() {
    let problem = two_rooms_cut([2, 1, 1]);
    for processors in [0, 3] {
        let error = simulate(&run(&problem, processors, rules()), &paragon()).unwrap_err();
        assert!(matches!(error, RunError::Processors { environments: 2, .. }), "{error}");
    }
    let mut machine = paragon();
    machine.processor.cycles.remove("ray");
    let error = simulate(&run(&problem, 2, rules()), &machine).unwrap_err();
    assert!(error.to_string().contains("\"ray\""), "{error}");
}
