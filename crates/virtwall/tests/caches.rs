//! Caches of the virtual processors: what they cost a run, and nothing else.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use std::sync::Arc;

use common::{problem, rules, same, two_rooms};
use desim::Duration;
use multicomputer::{CacheLevel, Machine};
use radiosity::{Light, Mask, Operation, Record, shoot_plainly, trace};
use virtwall::{KeptShots, Order, Outcome, Rules, Run, simulate};

/// The Paragon with caches of so many bytes, none: without caches.
fn on(run: &Run, size: Option<u64>) -> Outcome {
    simulate(run, &machine(size)).unwrap()
}

fn machine(size: Option<u64>) -> Machine {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../machines/paragon-xps.json");
    let mut machine = Machine::from_json(&std::fs::read_to_string(path).unwrap(), path).unwrap();
    let level = |size| CacheLevel { size, line: 32, ways: 2, miss_time: 1e-6 };
    machine.processor.caches = size.map(level).into_iter().collect();
    machine
}

fn rooms(processors: usize) -> Run {
    Run {
        problem: Arc::new(problem(two_rooms(), [8, 4, 4], [4, 2, 1], 1_024, 0.5)),
        processors,
        // What is collected as time goes by would differ.
        rules: Rules { collect_every: Duration::from_seconds_f64(1e6), ..rules() },
        kept: Arc::new(KeptShots::new(1 << 30)),
        on_shot: Arc::new(|_| ()),
    }
}

fn missing(outcome: &Outcome) -> Duration {
    outcome.nodes.iter().map(|node| node.missing).sum()
}

#[test]
fn misses_take_their_time_and_change_nothing_else() {
    let run = rooms(1);
    let (without, small, large) = (on(&run, None), on(&run, Some(4_096)), on(&run, Some(1 << 22)));
    assert_eq!(missing(&without), Duration::ZERO);
    assert!(missing(&large) > Duration::ZERO && missing(&small) > missing(&large) * 2);
    for mut with in [small, large] {
        let missing = missing(&with);
        assert_eq!(with.time - without.time, missing);
        assert_eq!(with.nodes[0].compute - without.nodes[0].compute, missing);
        (with.time, with.nodes) = (without.time, without.nodes.clone());
        same(&with, &without);
    }
}

#[test]
fn environments_in_turn_miss_less_a_shot() {
    let best = rooms(1);
    let in_turn = Run { rules: Rules { order: Order::InTurn, ..best.rules.clone() }, ..rooms(1) };
    let a_shot = [best, in_turn].map(|run| {
        let outcome = on(&run, Some(65_536));
        let shots = outcome.counts.local_shots + outcome.counts.received_shots;
        missing(&outcome).as_seconds_f64() / shots as f64
    });
    assert!(a_shot[1] < a_shot[0], "seconds: {a_shot:?}");
}

#[test]
fn translations_take_their_time_and_change_nothing_else() {
    let run = rooms(1);
    let pages = |entries| {
        let mut machine = machine(Some(1 << 22));
        let page = 4_096;
        let pages = CacheLevel { size: entries * page, line: page, ways: entries, miss_time: 1e-6 };
        machine.processor.translations = Some(pages);
        simulate(&run, &machine).unwrap()
    };
    let (without, few, many) = (on(&run, Some(1 << 22)), pages(8), pages(4_096));
    assert!(many.translating() > Duration::ZERO && few.translating() > many.translating() * 2);
    for with in [few, many] {
        assert_eq!(missing(&with), missing(&without));
        assert_eq!(with.time - without.time, with.translating());
    }
}

#[test]
fn kept_shots_and_processors_do_not_change_what_misses() {
    let run = rooms(3);
    let (first, again) = (on(&run, Some(4_096)), on(&run, Some(4_096)));
    same(&first, &again);
    assert!(first.nodes.iter().all(|node| node.missing > Duration::ZERO));
}

#[test]
fn a_trace_touches_what_the_slow_kernel_counts() {
    let problem = problem(two_rooms(), [8, 4, 4], [2, 1, 1], 1_024, 0.5);
    let environment = &problem.environments[0];
    let (space, hemisphere) = (&problem.space, &problem.hemisphere);
    let light = Light::new(space, environment);
    let mask = Mask::all(hemisphere.pixels());
    let (mut shots, mut tests) = (0, 0);
    for patch in (0..environment.patches.len() as u32).step_by(7) {
        let source = light.emitter(space, environment, 0, patch);
        let work = shoot_plainly(space, environment, hemisphere, &source, &mask).work;
        let (mut rays, mut cells, mut listed, mut hits) = (0, 0, 0, 0);
        let (mut crossings, mut words, mut planes) = (0, 0, 0);
        let mut searched = Vec::new();
        trace(space, environment, hemisphere, &source, &mask, |record| match record {
            Record::Direction(_) => rays += 1,
            Record::Cell { polygons, .. } => {
                (cells, listed) = (cells + 1, listed + u64::from(polygons));
            }
            Record::Plane(polygon) => assert_ne!(polygon, source.polygon),
            Record::Search { axis, plane } => searched.push((axis, plane)),
            Record::Crossing { .. } => crossings += 1,
            Record::Edges { edges, .. } => {
                assert!((1..=4).contains(&edges));
                tests += 1;
            }
            Record::Hit { .. } => hits += 1,
            Record::Copy => words += mask.words().len() as u64,
            Record::PlaneTest(_) => planes += 1,
        });
        let found = [rays, cells, listed, words, planes];
        let counted = [
            Operation::Ray,
            Operation::CellStep,
            Operation::PolygonTest,
            Operation::WordCopied,
            Operation::PlaneTest,
        ];
        assert_eq!(found, counted.map(|operation| work.of(operation)));
        // Three on entry, one a step from cell to cell.
        assert_eq!(crossings, 2 * rays + cells);
        assert!(hits <= work.of(Operation::Hit) && hits > 0);
        // A search for a cell has looked at both of its planes, but for the grid's outermost.
        let cell = space.grid.cell_of(source.centre);
        for (axis, &low) in cell.iter().enumerate() {
            let inner =
                [low, low + 1].into_iter().filter(|&p| p > 0 && p < space.grid.cells()[axis]);
            for plane in inner {
                let times = searched.iter().filter(|&&found| found == (axis, plane)).count();
                assert!(times as u64 >= rays, "{axis} {plane}: {times}");
            }
        }
        shots += 1;
    }
    assert!(shots > 5 && tests > 0);
}
