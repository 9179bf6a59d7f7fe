//! Memory of the virtual nodes: what it costs a run, and nothing else.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use std::sync::Arc;

use common::{grey, problem, rules, same, scene, sides};
use desim::{Duration, Time};
use multicomputer::Machine;
use virtwall::{KeptShots, Outcome, Problem, Run, RunError, simulate};

/// The Paragon with nodes that have so many bytes left, a mebibyte of them for messages; none:
/// memory is not modelled.
fn paragon(available: Option<u64>) -> Machine {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../machines/paragon-gp16.json");
    let mut machine = Machine::from_json(&std::fs::read_to_string(path).unwrap(), path).unwrap();
    match (available, &mut machine.node_memory) {
        (Some(available), Some(memory)) => memory.available = available,
        (_, memory) => *memory = None,
    }
    machine
}

fn run(problem: Problem) -> Run {
    Run {
        problem: Arc::new(problem),
        processors: 1,
        rules: rules(),
        kept: Arc::new(KeptShots::new(1 << 30)),
        on_shot: Arc::new(|_| ()),
    }
}

fn two_rooms(processors: usize) -> Run {
    Run { processors, ..run(problem(common::two_rooms(), [8, 4, 4], [4, 2, 1], 1_024, 0.5)) }
}

fn on(run: &Run, available: Option<u64>) -> Outcome {
    simulate(run, &paragon(available)).unwrap()
}

fn paging(outcome: &Outcome) -> Duration {
    outcome.nodes.iter().map(|node| node.paging).sum()
}

fn high_water(outcome: &Outcome) -> u64 {
    outcome.nodes.iter().filter_map(|node| node.memory_high_water).max().unwrap()
}

#[test]
fn enough_memory_costs_nothing() {
    for processors in [1, 3, 8] {
        let run = two_rooms(processors);
        let without = on(&run, None);
        assert!(without.nodes.iter().all(|node| node.memory_high_water.is_none()));
        let mut ample = on(&run, Some(1 << 30));
        let full = high_water(&ample);
        let mut just = on(&run, Some(full));
        assert_eq!(high_water(&just), full);
        for node in ample.nodes.iter_mut().chain(&mut just.nodes) {
            node.memory_high_water = None;
        }
        same(&ample, &without);
        same(&just, &without);
    }
}

/// On one processor nothing but the time changes, so that every run uses the same in the same order.
#[test]
fn too_little_memory_costs_the_more_the_less_there_is() {
    let run = two_rooms(1);
    let full = high_water(&on(&run, Some(1 << 30)));
    let steps = (0..=40).map(|i| full - i * full / 40);
    let outcomes: Vec<Outcome> = steps.map(|available| on(&run, Some(available))).collect();
    assert!(outcomes.is_sorted_by_key(paging) && outcomes.is_sorted_by_key(|o| o.time));
    assert_eq!(paging(&outcomes[0]), Duration::ZERO);
    assert!(paging(&outcomes[20]) > paging(&outcomes[2]) && paging(&outcomes[2]) > Duration::ZERO);
    for Outcome { time, nodes, work, radiosity, .. } in &outcomes {
        assert!(*work == outcomes[0].work && *radiosity == outcomes[0].radiosity);
        let spent = nodes[0].compute + nodes[0].overhead + nodes[0].paging + nodes[0].idle;
        assert_eq!(spent, *time - Time::ZERO);
    }
}

#[test]
fn paging_is_the_same_every_time() {
    let run = two_rooms(2);
    let [one, other] = [(), ()].map(|()| on(&run, Some(1_700_000)));
    assert!(paging(&one) > Duration::ZERO);
    same(&one, &other);
}

/// A box in two halves, of five polygons and five patches each, that reflect nothing; one wall shines
/// into the other half: once a source waits in the queue.
#[test]
fn the_high_water_mark_is_what_there_was() {
    let walls = sides([0.0; 3], [2.0, 1.0, 1.0], [0, 0, 0, 0, 0, 1], true);
    let scene = scene(&walls, vec![grey(0.0, 0.0), grey(0.0, 1.0)]);
    let outcome = on(&run(problem(scene, [2, 1, 1], [2, 1, 1], 64, 1.5)), Some(1 << 30));
    assert_eq!((outcome.counts.local_shots, outcome.counts.received_shots), (1, 1));
    let half = 8 + 5 * 8 + 5 * 264 + 5 * 300;
    let program = 512 * 1024 + 64 * 24;
    let (queued, buffers) = (224 + 2 * 4, 1024 * 1024);
    assert_eq!(high_water(&outcome), 2 * half + program + queued + buffers);
}

#[test]
fn a_thing_without_a_size_is_refused() {
    let mut machine = paragon(Some(1 << 30));
    machine.node_memory.as_mut().unwrap().sizes.remove("cell");
    let error = simulate(&two_rooms(1), &machine).unwrap_err();
    assert!(matches!(error, RunError::Missing { name: "cell", .. }), "{error}");
}
