//! Published times of other models and simulators.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use desim::{Duration, Time};
use multicomputer::{
    LinkParameters, LogGpParameters, NetworkModel, NetworkParameters, Place, RouterStages,
    Schedule, Shape, Topology, Trace, TraceMessage, perform, replay,
};

/// L, o, g in nanoseconds, and bytes a second, on a crossbar without hop time.
fn loggp(places: u32, [l, o, g]: [u64; 3], bandwidth: f64) -> (NetworkParameters, Topology) {
    let [latency, overhead, gap] = [l, o, g].map(|ns| Duration(ns * 1_000));
    let software = LogGpParameters {
        send_overhead: overhead,
        latency,
        hop_time: Duration::ZERO,
        receive_overhead: overhead,
        gap,
        bandwidth,
    };
    let parameters = NetworkParameters { software: Some(software), links: None };
    (parameters, Topology::new(Shape::Crossbar { places }))
}

/// The end of a GOAL schedule on the model `loggp`.
fn end(goal: &str, places: u32, parameters: [u64; 3], bandwidth: f64) -> Time {
    let (parameters, topology) = loggp(places, parameters, bandwidth);
    let schedule = Schedule::from_goal(goal, "t.goal", places as usize).unwrap();
    let mut network = parameters.build(NetworkModel::LogGp, &topology).unwrap();
    perform(&schedule, network.as_mut()).unwrap().1
}

/// Sends to these ranks, after what `receive` says.
fn sends(receive: &str, ranks: &[usize], bytes: u64) -> String {
    let mut text = receive.to_owned();
    for (i, rank) in ranks.iter().enumerate() {
        text += &format!("s{i}: send {bytes}b to {rank}\n");
        if !receive.is_empty() {
            text += &format!("s{i} requires r\n");
        }
    }
    text
}

fn goal(ranks: &[String]) -> String {
    let text = ranks.iter().enumerate().map(|(rank, text)| format!("rank {rank} {{\n{text}}}\n"));
    format!("num_ranks {}\n{}", ranks.len(), text.collect::<String>())
}

/// A broadcast along a tree: the children of each rank, in the order of sending.
fn broadcast(children: &[Vec<usize>], bytes: u64) -> String {
    let ranks = (0..children.len()).map(|rank| {
        let parent = children.iter().position(|children| children.contains(&rank));
        let receive = parent.map(|parent| format!("r: recv {bytes}b from {parent}\n"));
        sends(&receive.unwrap_or_default(), &children[rank], bytes)
    });
    goal(&ranks.collect::<Vec<_>>())
}

/// Culler and others: LogP, PPoPP 1993, Figure 3: the optimal broadcast with L = 6, o = 2, g = 4, P = 8 takes 24.
#[test]
fn logp_broadcasts_in_24() {
    let none = Vec::new;
    let tree = [vec![1, 2, 3, 4], vec![5, 6], vec![7], none(), none(), none(), none(), none()];
    assert_eq!(end(&broadcast(&tree, 0), 8, [6, 2, 4], 1e9), Time(24_000));
    // Of all trees it is the best; a star takes (P - 2) g + L + 2 o.
    let star: Vec<_> =
        (0..8).map(|rank| if rank == 0 { (1..8).collect() } else { none() }).collect();
    assert_eq!(end(&broadcast(&star, 0), 8, [6, 2, 4], 1e9), Time(34_000));
}

/// LogGOPSim's README: its example, dissemination on 16 ranks, ends at 22,000 ns with default parameters.
/// So does a binomial tree, whose longest path has as many messages.
#[test]
fn loggopsim_disseminates_in_22_microseconds() {
    let ranks = (0..16).map(|rank| {
        let rounds = (0..4).map(|round| {
            let (to, from) = ((rank + (1 << round)) % 16, (rank + 16 - (1 << round)) % 16);
            let after = match round {
                0 => String::new(),
                _ => format!("s{round} requires r{0}\nr{round} requires r{0}\n", round - 1),
            };
            format!("s{round}: send 1b to {to}\nr{round}: recv 1b from {from}\n{after}")
        });
        rounds.collect::<String>()
    });
    let disseminated = end(&goal(&ranks.collect::<Vec<_>>()), 16, [2_500, 1_500, 1_000], 1e9 / 6.0);
    let children = |rank: usize| {
        let least = if rank == 0 { 16 } else { rank & rank.wrapping_neg() };
        (0..4)
            .rev()
            .map(|bit| 1 << bit)
            .filter(|step| *step < least)
            .map(|step| rank + step)
            .collect()
    };
    let tree: Vec<Vec<usize>> = (0..16).map(children).collect();
    let broadcasted = end(&broadcast(&tree, 1), 16, [2_500, 1_500, 1_000], 1e9 / 6.0);
    for found in [disseminated, broadcasted] {
        // A byte takes its G here; LogGOPSim charges the bytes after the first one.
        assert_eq!(found, Time(22_000_000 + 4 * 6_000));
    }
}

/// Seven ranks send a million bytes to one. LogGOPSim with L = 2500, o = 1500, g = 1000, G = 10 ns reads the
/// last message after 70.0144 ms: its receiver's processor is busy while a message comes in, so that each of
/// seven messages adds o. Here a node's port works alone, so that each of six adds g.
#[test]
fn loggopsim_reads_seven_messages_one_after_the_other() {
    let root = (1..8).map(|rank| format!("recv 1000000b from {rank}\n")).collect();
    let others = (1..8).map(|_| "send 1000000b to 0\n".to_owned());
    let ranks: Vec<String> = std::iter::once(root).chain(others).collect();
    let found = end(&goal(&ranks), 8, [2_500, 1_500, 1_000], 1e8);
    assert_eq!(found, Time(70_011_500_000));
    assert!((found.as_seconds_f64() / 70.0144e-3 - 1.0).abs() < 1e-4);
}

/// SimGrid's examples/platforms/cluster_torus.xml: links of 50 µs and 125 MB/s, routed dimension by dimension the
/// shorter way round; a message takes the latencies of its links and its bytes at the bandwidth. Its torus is
/// 3 × 2 × 2; this is one of its planes.
#[test]
fn simgrid_routes_the_shorter_way_round_a_torus() {
    let topology = Topology::new(Shape::Torus { width: 3, height: 2 });
    let (latency, bandwidth) = (Duration(50_000_000), 125e6);
    let software = LogGpParameters::bare(latency, bandwidth);
    let links = LinkParameters {
        bandwidth,
        flit_bytes: 1_000,
        buffer_flits: 8,
        virtual_channels: 2,
        stages: RouterStages::default(),
    };
    let parameters = NetworkParameters { software: Some(software), links: Some(links) };
    for model in [NetworkModel::LogGp, NetworkModel::Wormhole] {
        for (to, hops) in [(1, 1), (2, 1), (3, 1), (4, 2), (5, 2)] {
            assert_eq!(topology.hops(Place::new(0), Place::new(to)), hops);
            let (name, after) = (String::new(), Vec::new());
            let message =
                TraceMessage { name, at: Time::ZERO, from: 0, to, bytes: 1_000_000, after };
            let mut network = parameters.build(model, &topology).unwrap();
            let trace = Trace { messages: vec![message] };
            let arrived = replay(&trace, network.as_mut(), &topology).unwrap()[0].arrived;
            // 1 MB at 125 MB/s: 8 ms.
            assert_eq!(arrived, Time::ZERO + Duration(8_000_000_000) + latency * u64::from(hops));
        }
    }
}
