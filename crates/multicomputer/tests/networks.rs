//! The network models: closed formulas, fixtures, comparisons, and invariants.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use desim::{Duration, Simulation, Time};
use multicomputer::{
    Channel, LinkParameters, Load, LogGpParameters, Machine, Measured, Multicomputer, Network,
    NetworkModel, NetworkParameters, Pattern, Place, ReplayedMessage, RouterStages, Shape,
    Topology, Trace, TraceMessage, exchange, ping_pong, replay,
};
use proptest::prelude::*;

fn machines(name: &str) -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../machines")).join(name)
}

fn machine(name: &str) -> Machine {
    let file = format!("{name}.json");
    Machine::from_json(&fs::read_to_string(machines(&file)).unwrap(), &file).unwrap()
}

/// Replays a fixture on a model.
fn fixture(
    trace: &str,
    machine_name: &str,
    model: NetworkModel,
) -> Result<Vec<ReplayedMessage>, String> {
    let machine = machine(&format!("fixtures/{machine_name}"));
    let file = format!("fixtures/{trace}.json");
    let text = fs::read_to_string(machines(&file)).unwrap();
    let trace = Trace::from_json(&text, &file, machine.nodes()).unwrap();
    let mut network = machine.network_on(model).unwrap();
    replay(&trace, network.as_mut(), machine.topology()).map_err(|error| error.to_string())
}

fn seconds(replayed: &[ReplayedMessage]) -> Vec<f64> {
    replayed.iter().map(|times| times.arrived.as_seconds_f64()).collect()
}

const ABOVE_IDEAL: [NetworkModel; 3] =
    [NetworkModel::LogGp, NetworkModel::Wormhole, NetworkModel::Flit];
const CONTENDING: [NetworkModel; 2] = [NetworkModel::Wormhole, NetworkModel::Flit];

#[test]
fn a_blocked_message_blocks_those_behind_it() {
    let worms = fixture("head-of-line", "row-of-4", NetworkModel::Wormhole).unwrap();
    assert_eq!(seconds(&worms), [1.0, 2.0, 3.0]);
    let blocked = |times: &ReplayedMessage| (times.blocked().as_seconds_f64(), times.blockers());
    assert_eq!(
        worms.iter().map(blocked).collect::<Vec<_>>(),
        [(0.0, vec![]), (1.0, vec![0]), (2.0, vec![1]),]
    );
    // The pipelines fill: a flit's time, 100 µs, a hop, and eight flits wait in each buffer.
    let flits = fixture("head-of-line", "row-of-4", NetworkModel::Flit).unwrap();
    for (times, expected) in flits.iter().zip([1.0, 2.0, 3.0]) {
        assert!((times.arrived.as_seconds_f64() - expected).abs() < 2e-3, "{times:?}");
    }
    assert_eq!(
        flits.iter().map(ReplayedMessage::blockers).collect::<Vec<_>>(),
        [vec![], vec![0], vec![1]]
    );
    // Without contention only ports are waited for: the second by its receiver, the third by its sender.
    let free = fixture("head-of-line", "row-of-4", NetworkModel::LogGp).unwrap();
    assert_eq!(seconds(&free), [1.0, 2.0, 2.0]);
}

#[test]
fn a_ring_without_virtual_channels_deadlocks_and_names_the_circle() {
    for model in CONTENDING {
        let message = fixture("round-the-ring", "ring-of-4", model).unwrap_err();
        let circle = [
            r#""from-2" (2 to 0) waits for link 3→0, held by "#,
            r#""from-3" (3 to 1) waits for link 0→1, held by "#,
            r#""from-0" (0 to 2) waits for link 1→2, held by "#,
            r#""from-1" (1 to 3) waits for link 2→3, held by "#,
        ];
        assert!(message.contains("deadlock in the network: "), "{model}: {message}");
        assert!(circle.iter().all(|part| message.contains(part)), "{model}: {message}");
        let replayed = fixture("round-the-ring", "ring-of-4-two-channels", model).unwrap();
        assert!(replayed.iter().all(|times| times.arrived > Time::ZERO), "{model}");
    }
}

#[test]
fn alone_a_message_takes_the_time_of_the_formula() {
    let paragon = machine("paragon-xps");
    let software = paragon.parameters.software.clone().unwrap();
    let near = |found: Time, expected: Duration, what: &str| {
        let (found, expected) = (found.as_seconds_f64(), expected.as_seconds_f64());
        assert!((found / expected - 1.0).abs() < 1e-3, "{what}: {found} for {expected}");
    };
    for model in ABOVE_IDEAL {
        let network = || paragon.network_on(model).unwrap();
        for bytes in [0, 1, 100, 4_096, 65_536] {
            for (partner, hops) in [(1, 1), (2, 2), (55, 16)] {
                let what = format!("{model}, {bytes} B, 0 to {partner}");
                let one_way = software.one_way(bytes, hops);
                let time = ping_pong(&paragon, network(), (0, partner), bytes, 3).unwrap();
                near(time, one_way * 6, &what);
            }
            let items = [(0, 1), (1, 0)].map(|(from, to)| item(Time::ZERO, from, to, bytes));
            let trace = Trace { messages: items.to_vec() };
            let replayed = replay(&trace, network().as_mut(), paragon.topology()).unwrap();
            for times in replayed {
                near(times.arrived, software.one_way(bytes, 1), "exchange");
            }
        }
    }
}

fn item(at: Time, from: usize, to: usize, bytes: u64) -> TraceMessage {
    TraceMessage { name: String::new(), at, from, to, bytes, after: Vec::new() }
}

#[test]
fn an_exchange_of_neighbours_costs_the_same_with_and_without_contention() {
    // Ports are slower than links, and a row's ends are three links apart, which others use too.
    let paragon = machine("paragon-xps");
    let time = |model| {
        let network = paragon.network_on(model).unwrap();
        exchange(&paragon, network, 56, 4_096, 2).unwrap().as_seconds_f64()
    };
    let expected = time(NetworkModel::LogGp);
    for model in CONTENDING {
        assert!((time(model) / expected - 1.0).abs() < 2e-3, "{model}: {} {expected}", time(model));
    }
}

#[test]
fn alone_a_message_takes_the_same_time_whatever_the_routers_stages() {
    let paragon = machine("paragon-xps");
    let arrival = |stages: RouterStages| {
        let mut parameters = paragon.parameters.clone();
        parameters.links.as_mut().unwrap().stages = stages;
        let mut network = parameters.build(NetworkModel::Flit, paragon.topology()).unwrap();
        let trace = Trace { messages: vec![item(Time::ZERO, 0, 55, 4_096)] };
        replay(&trace, network.as_mut(), paragon.topology()).unwrap()[0].arrived
    };
    // A hop of 40 ns is three cycles.
    let default = RouterStages::default();
    for (routing, allocation) in [(0, 0), (1, 0), (0, 1), (1, 1), (0, 2)] {
        for credit in [1, 2, 5] {
            let stages = RouterStages { routing, allocation, credit };
            assert_eq!(arrival(stages), arrival(default), "{stages:?}");
        }
    }
}

/// A message that waits at a router has been routed when the channel is free, and only its allocation takes
/// cycles more; one in the same buffer as the message before it is routed as well.
#[test]
fn a_channel_is_idle_while_its_next_message_is_allocated_to_it() {
    let topology = Topology::new(Shape::Mesh { width: 3, height: 1 });
    for (routing, allocation) in [(0, 0), (1, 0), (0, 1), (1, 1), (0, 3)] {
        for (second, idle) in [(2, allocation), (0, routing + allocation)] {
            let mut parameters = bare(1, 6, 1);
            parameters.links.as_mut().unwrap().stages =
                RouterStages { routing, allocation, credit: 1 };
            let mut network = parameters.build(NetworkModel::Flit, &topology).unwrap();
            let items = [item(Time::ZERO, 0, 1, 100), item(Time(12_000), second, 1, 20)];
            let trace = Trace { messages: items.to_vec() };
            let replayed = replay(&trace, network.as_mut(), &topology).unwrap();
            let apart = replayed[1].arrived - replayed[0].arrived;
            assert_eq!(apart, Duration(1_000) * (20 + idle), "{second} {routing} {allocation}");
        }
    }
}

/// A network without software, with a cycle of 1 ns and a hop of `cycles`.
fn bare(flit_bytes: u64, cycles: u64, virtual_channels: u32) -> NetworkParameters {
    let bandwidth = flit_bytes as f64 * 1e9;
    let software = LogGpParameters::bare(Duration(1_000) * cycles, bandwidth);
    let links = LinkParameters {
        bandwidth,
        flit_bytes,
        buffer_flits: 8,
        virtual_channels,
        stages: RouterStages::default(),
    };
    NetworkParameters { software: Some(software), links: Some(links) }
}

/// Mean latencies of both models with contention below saturation, that is where flits take less than
/// three times as long as on an empty network.
#[test]
fn wormhole_takes_as_long_as_flit() {
    let topology = Topology::new(Shape::Mesh { width: 8, height: 8 });
    for (pattern, loads) in [
        (Pattern::Uniform, [0.05, 0.15]),
        (Pattern::Neighbour, [0.1, 0.4]),
        (Pattern::Transpose, [0.03, 0.1]),
        (Pattern::HotSpot, [0.02, 0.05]),
        (Pattern::AllToOne, [0.005, 0.011]),
    ] {
        for share in loads {
            // 4 KB are 128 flits: 128 ns.
            let every = Duration((128_000.0 / share) as u64);
            let until = Time::ZERO + every * 30;
            let load = Load { pattern, bytes: 4_096, every, until, seed: 1996 };
            let trace = load.trace(&topology, 64);
            let [worms, flits] = CONTENDING.map(|model| {
                let mut network = bare(32, 2, 1).build(model, &topology).unwrap();
                let replayed = replay(&trace, network.as_mut(), &topology).unwrap();
                Measured::of(&load, &trace, &replayed).latency
            });
            assert!(flits < 3.0 * 128e-9, "{} {share} is saturated: {flits}", pattern.name());
            let difference = worms / flits - 1.0;
            assert!(difference.abs() < 0.15, "{} {share}: {difference}", pattern.name());
        }
    }
}

#[test]
fn golden_times_of_a_reduction() {
    // Four nodes of a row send to the first one; the farther ones' worms wait where they meet, and
    // the answer goes out when all have been read.
    let text = r#"[
        {"id": 1, "at": "0 us", "from": 1, "to": 0, "bytes": 4096},
        {"id": 2, "at": "1 us", "from": 2, "to": 0, "bytes": 4096},
        {"id": 3, "at": "0 us", "from": 3, "to": 0, "bytes": 4096},
        {"id": "answer", "at": "0 us", "from": 0, "to": 3, "bytes": 0, "after": [1, 2, 3]}
    ]"#;
    let paragon = machine("paragon-xps");
    let trace = Trace::from_json(text, "t.json", paragon.nodes()).unwrap();
    let mut network = paragon.network_on(NetworkModel::Wormhole).unwrap();
    let replayed = replay(&trace, network.as_mut(), paragon.topology()).unwrap();
    let lines = replayed.iter().zip(&trace.messages).map(|(times, item)| {
        let (sent, arrived, blocked) = (times.sent, times.arrived, times.blocked());
        format!("{} {sent} {arrived} {blocked} {:?}", item.name, times.blockers())
    });
    assert_eq!(
        lines.collect::<Vec<_>>(),
        [
            "1 0 s 105.055385 µs 0 s []",
            "2 1 µs 151.866813 µs 45.771428 µs [2]",
            "3 0 s 128.461099 µs 23.325714 µs [0]",
            "answer 151.866813 µs 193.986813 µs 0 s []",
        ]
    );
}

/// Machines of every topology, small enough for contention.
fn shapes() -> impl Strategy<Value = Shape> {
    prop_oneof![
        (1..5_u16, 1..4_u16).prop_map(|(width, height)| Shape::Mesh { width, height }),
        (1..5_u16, 1..4_u16).prop_map(|(width, height)| Shape::Torus { width, height }),
        (1..7_u32).prop_map(|places| Shape::Crossbar { places }),
        (1..7_u32).prop_map(|places| Shape::Bus { places }),
    ]
}

proptest! {
    /// Any traffic, on any topology and model: every message arrives once, in order between each
    /// pair, and not before the formula says; no channel carries two messages at a time.
    #[test]
    fn messages_arrive_once_in_order_and_not_early(
        shape in shapes(),
        letters in prop::collection::vec((0..100_usize, 0..100_usize, 1..600_u64, 0..900_u64), 1..40),
        model in prop::sample::select(ABOVE_IDEAL.to_vec()),
        stages in prop::sample::select(vec![(0, 0, 1), (1, 0, 3), (0, 1, 2)]),
    ) {
        let topology = Topology::new(shape);
        let places = topology.places();
        let mut parameters = bare(4, 2, 2);
        let (routing, allocation, credit) = stages;
        parameters.links.as_mut().unwrap().stages = RouterStages { routing, allocation, credit };
        let software = parameters.software.clone().unwrap();
        let items = letters.iter().map(|&(from, to, bytes, at)| {
            item(Time(at * 1_000), from % places, to % places, bytes)
        });
        let trace = Trace { messages: items.collect() };
        let mut network = parameters.build(model, &topology).unwrap();
        let replayed = replay(&trace, network.as_mut(), &topology).unwrap();
        let mut lasts = BTreeMap::new();
        let mut order: Vec<usize> = (0..trace.messages.len()).collect();
        order.sort_by_key(|&i| (replayed[i].sent, i));
        for i in order {
            let (item, times) = (&trace.messages[i], &replayed[i]);
            let places = [item.from, item.to].map(Place::new);
            let least = software.one_way(item.bytes, topology.hops(places[0], places[1]));
            prop_assert!(times.arrived >= times.sent + least);
            prop_assert!(times.sent >= item.at);
            let last = lasts.insert((item.from, item.to), times.arrived);
            prop_assert!(last.is_none_or(|last| last <= times.arrived));
        }
        one_at_a_time(&trace, &replayed, network.as_ref(), model)?;
    }

    /// First come, first served: heads of worms from everywhere reach a crossbar's way out in the
    /// order in which they were sent.
    #[test]
    fn who_comes_first_is_served_first(
        starts in prop::collection::vec(0..2_000_u64, 2..12),
        model in prop::sample::select(CONTENDING.to_vec()),
    ) {
        let topology = Topology::new(Shape::Crossbar { places: 13 });
        let items = starts.iter().enumerate().map(|(i, &at)| item(Time(at * 1_000), i + 1, 0, 400));
        let trace = Trace { messages: items.collect() };
        let mut network = bare(4, 2, 1).build(model, &topology).unwrap();
        let replayed = replay(&trace, network.as_mut(), &topology).unwrap();
        let mut order: Vec<usize> = (0..starts.len()).collect();
        order.sort_by_key(|&i| (starts[i], i));
        prop_assert!(order.windows(2).all(|pair| replayed[pair[0]].arrived < replayed[pair[1]].arrived));
    }
}

/// Every channel was held by one message at a time: none was held for longer than the run, and messages
/// arrived at a node one after the other.
fn one_at_a_time(
    trace: &Trace,
    replayed: &[ReplayedMessage],
    network: &dyn Network,
    model: NetworkModel,
) -> Result<(), TestCaseError> {
    let end = replayed.iter().map(|times| times.arrived).max().unwrap_or_default();
    for used in network.channel_use() {
        let lanes = match used.channel {
            Channel::Link(_) => 2,
            Channel::Injection(_) | Channel::Ejection(_) => 1,
        };
        prop_assert!(used.held <= (end - Time::ZERO) * lanes, "{used:?}");
        prop_assert!(used.carrying <= end - Time::ZERO, "{used:?}");
    }
    if model == NetworkModel::LogGp {
        return Ok(());
    }
    let mut arrivals: Vec<_> =
        trace.messages.iter().zip(replayed).map(|(i, c)| (i.to, c.arrived, i.bytes)).collect();
    arrivals.sort_unstable();
    for pair in arrivals.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
        prop_assert!(pair[1].1 >= pair[0].1 + Duration(250) * pair[1].2, "{pair:?}");
    }
    Ok(())
}

#[test]
fn a_program_in_deadlock_is_halted_with_a_report() {
    let ring = machine("fixtures/ring-of-4");
    let simulation = Simulation::new();
    let nodes = Multicomputer::<()>::new(&simulation.handle(), &ring, 3).unwrap();
    for rank in 0..4 {
        let node = nodes.node(rank);
        simulation.handle().spawn(format!("node {rank}"), async move {
            node.send((rank + 2) % 4, 1_000_000, ()).await;
            node.wait().await;
        });
    }
    let stalled = simulation.run().unwrap_err();
    let message = stalled.to_string();
    assert!(
        message.starts_with("stalled at 200 µs: deadlock in the network: a message ("),
        "{message}"
    );
    assert!(message.ends_with("node 3 waits for mail at node 3"), "{message}");
    assert_eq!(nodes.deadlock().unwrap().circle.len(), 4);
}
