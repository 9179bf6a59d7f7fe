//! The automatic choice of a network model, and the record of messages on which it is based.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::convert::Infallible;
use std::fs;

use desim::{Duration, Simulation, Time};
use multicomputer::{
    AutoResult, Machine, Multicomputer, Network, NetworkModel, Recorder, choose, exchange, hot_spot,
};
use serde_json::Value;

fn paragon() -> Value {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../machines/paragon-xps.json");
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

fn machine(file: &Value) -> Machine {
    Machine::from_json(&file.to_string(), "m.json").unwrap()
}

fn chosen(
    machine: &Machine,
    tolerance: f64,
    program: impl Fn(&Machine, Box<dyn Network>) -> Time,
) -> AutoResult<()> {
    let run = |network| Ok::<_, Infallible>((program(machine, network), ()));
    choose(&machine.parameters, machine.topology(), tolerance, run).unwrap()
}

/// Two nodes that compute for a second and then exchange a message.
fn computes(machine: &Machine, network: Box<dyn Network>) -> Time {
    let simulation = Simulation::new();
    let handle = simulation.handle();
    let nodes = Multicomputer::<()>::with_network(&handle, machine, 2, network).unwrap();
    for (rank, partner) in [(0, 1), (1, 0)] {
        let node = nodes.node(rank);
        handle.spawn(format!("node {rank}"), async move {
            node.compute(Duration::from_seconds_f64(1.0)).await;
            node.send(partner, 4_096, ()).await;
            node.wait().await;
            node.received().await;
        });
    }
    simulation.run().unwrap()
}

/// The nodes of two rows send a message two rows down.
fn shares_links(machine: &Machine, network: Box<dyn Network>) -> Time {
    let simulation = Simulation::new();
    let handle = simulation.handle();
    let nodes = Multicomputer::<()>::with_network(&handle, machine, 16, network).unwrap();
    for rank in 0..16 {
        let node = nodes.node(rank);
        handle.spawn(format!("node {rank}"), async move {
            match rank {
                0..8 => node.send(rank + 8, 4_096, ()).await,
                _ => node.wait().await,
            }
        });
    }
    simulation.run().unwrap()
}

#[test]
fn the_cheapest_model_is_chosen_with_a_reason() {
    let paragon = machine(&paragon());
    let idle = chosen(&paragon, 0.01, computes);
    assert_eq!(idle.model, NetworkModel::Ideal);
    // 105 µs of a second.
    assert_eq!(
        idle.why,
        "the busiest link works 0.002 % of the time; a pilot of 2 of 2 messages on loggp adds at \
         most 0.011 %"
    );
    let strict = chosen(&paragon, 1e-5, computes);
    assert_eq!(strict.model, NetworkModel::LogGp);
    assert_eq!(strict.time, idle.time + Duration(105_055_385));

    // Messages only, each on its own port: LogGP is enough.
    let exchanged = chosen(&paragon, 0.01, |machine, network| {
        exchange(machine, network, 16, 4_096, 2).unwrap()
    });
    assert_eq!(exchanged.model, NetworkModel::LogGp, "{}", exchanged.why);

    // All send to one node: they share its port.
    let rushed = chosen(&paragon, 0.01, |machine, network| {
        hot_spot(machine, network, 16, 4_096, 2).unwrap()
    });
    assert_eq!(rushed.model, NetworkModel::LogGp, "{}", rushed.why);

    // Messages from different senders to different receivers share links, which LogGP does not model.
    let rushed = chosen(&paragon, 0.01, shares_links);
    assert_eq!(rushed.model, NetworkModel::Wormhole, "{}", rushed.why);
    assert!(rushed.record.blocked() > Duration::ZERO);
}

#[test]
fn the_choice_ends_at_the_models_that_the_machine_file_describes() {
    let mut file = paragon();
    file["network"].as_object_mut().unwrap().remove("links");
    let rushed = chosen(&machine(&file), 0.01, shares_links);
    assert_eq!(rushed.model, NetworkModel::LogGp);
    assert_eq!(rushed.why, "the machine's file says too little for wormhole");
}

#[test]
fn a_recorder_does_not_change_the_run_and_records_all_messages() {
    let paragon = machine(&paragon());
    let network = || paragon.network_on(NetworkModel::Wormhole).unwrap();
    let (recorder, record) = Recorder::new(network());
    let end = hot_spot(&paragon, Box::new(recorder), 8, 4_096, 3).unwrap();
    assert_eq!(end, hot_spot(&paragon, network(), 8, 4_096, 3).unwrap());
    let record = record.borrow();
    assert_eq!(record.messages.len(), 21);
    assert!(record.messages.iter().all(|message| message.arrived.is_some_and(|at| at <= end)));
    // The link from node 4 to node 0 carries the messages from the second row: 12.
    let links = paragon.parameters.links.clone().unwrap();
    let busiest = record.busiest_link(paragon.topology(), &links, end);
    let expected = 12.0 * 4_096.0 / 175e6 / end.as_seconds_f64();
    assert!((busiest / expected - 1.0).abs() < 1e-12, "{busiest} {expected}");
}
