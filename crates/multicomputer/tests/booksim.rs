//! The model `flit` beside BookSim2 (commit 28f4329), a cycle-accurate simulator of networks on chips.
//!
//! 8 × 8 mesh, `routing_function = dor`, `num_vcs = 1`, uniform traffic of packets of 20 flits, each node
//! to all 64 with equal probability; `vc_buf_size` and `routing_delay` as stated, all else by default. Its latencies
//! run from the cycle in which a packet is generated to the one in which its last flit is received.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use desim::{Duration, Time};
use multicomputer::{
    LinkParameters, LogGpParameters, NetworkModel, NetworkParameters, RouterStages, Shape,
    Topology, Trace, TraceMessage, replay,
};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

const CYCLE: Duration = Duration(1_000);
const FLITS: u64 = 20;
const NODES: usize = 64;

fn mesh() -> Topology {
    Topology::new(Shape::Mesh { width: 8, height: 8 })
}

/// BookSim2's router. A hop takes `routing_delay` and a cycle each for virtual channel, switch, crossbar and
/// link. A credit takes two cycles. A packet also passes the channel from its node, two cycles, and
/// the first router; its last cycle is not counted.
fn booksim(routing_delay: u64, vc_buf_size: u32) -> NetworkParameters {
    let stages = RouterStages { routing: routing_delay, allocation: 1, credit: 2 };
    network(4 + routing_delay, vc_buf_size, stages)
}

fn network(hop: u64, buffer_flits: u32, stages: RouterStages) -> NetworkParameters {
    let bandwidth = 1e9;
    let latency = CYCLE * (hop + 1);
    let software = LogGpParameters { latency, ..LogGpParameters::bare(CYCLE * hop, bandwidth) };
    let links =
        LinkParameters { bandwidth, flit_bytes: 1, buffer_flits, virtual_channels: 1, stages };
    NetworkParameters { software: Some(software), links: Some(links) }
}

fn packet(cycle: u64, from: usize, to: usize) -> TraceMessage {
    let at = Time::ZERO + CYCLE * cycle;
    TraceMessage { name: String::new(), at, from, to, bytes: FLITS, after: Vec::new() }
}

/// The cycles in which each packet is generated and has arrived.
fn cycles(network: &NetworkParameters, packets: Vec<TraceMessage>) -> Vec<(u64, u64)> {
    let trace = Trace { messages: packets };
    let mut network = network.build(NetworkModel::Flit, &mesh()).unwrap();
    let replayed = replay(&trace, network.as_mut(), &mesh()).unwrap();
    let cycle = |time: Time| time.0 / CYCLE.0;
    let both = trace.messages.iter().zip(&replayed);
    both.map(|(packet, times)| (cycle(packet.at), cycle(times.arrived))).collect()
}

/// Packets that BookSim2 sends through an empty network: source, destination, links between them, and the latency
/// with `routing_delay` 0 and 1.
const ALONE: [(usize, usize, u64, [u64; 2]); 10] = [
    (43, 51, 1, [29, 31]),
    (40, 33, 2, [33, 36]),
    (50, 60, 3, [37, 41]),
    (49, 53, 4, [41, 46]),
    (21, 34, 5, [45, 51]),
    (24, 51, 6, [49, 56]),
    (25, 53, 7, [53, 61]),
    (20, 48, 8, [57, 66]),
    (51, 15, 9, [61, 71]),
    (57, 31, 10, [65, 76]),
];

/// Each of the links and the first router take a hop's cycles; the flits follow, and the channel from the node
/// takes one cycle more than is not counted at the end.
#[test]
fn a_packet_alone_takes_booksims_cycles() {
    for (from, to, links, found) in ALONE {
        for (routing_delay, latency) in [0, 1].into_iter().zip(found) {
            let hop = 4 + routing_delay;
            assert_eq!(hop * (links + 1) + FLITS + 1, latency, "{from} to {to}");
            for vc_buf_size in [8, 16] {
                let network = booksim(routing_delay, vc_buf_size);
                assert_eq!(cycles(&network, vec![packet(3, from, to)]), [(3, 3 + latency)]);
            }
        }
    }
}

/// BookSim2's own packets, replayed. Nine of ten take the same number of cycles. The others are those that met at
/// a router: BookSim2's serves them round robin, this one first come, first served. On average that makes
/// no difference.
#[test]
fn booksims_packets_take_as_long_here() {
    let rows =
        include_str!("booksim-uniform-0.12.csv").lines().filter(|line| !line.starts_with('#'));
    let rows: Vec<Vec<u64>> =
        rows.map(|row| row.split(',').map(|cell| cell.parse().unwrap()).collect()).collect();
    let packets = rows.iter().map(|row| packet(row[0], row[1] as usize, row[2] as usize));
    let here = cycles(&booksim(0, 8), packets.collect());
    // Packets that arrived later may have met others, which are not in the file.
    let last = rows.last().unwrap()[0];
    let both = rows.iter().zip(here).filter(|(row, _)| row[3] <= last);
    let pairs: Vec<[u64; 2]> = both.map(|(row, here)| [row[3] - row[0], here.1 - here.0]).collect();
    let equal = pairs.iter().filter(|[there, here]| there == here).count();
    assert!(equal * 10 >= pairs.len() * 9, "{equal} of {}", pairs.len());
    let [there, here] = [0, 1].map(|side| pairs.iter().map(|pair| pair[side]).sum::<u64>() as f64);
    assert!((here / there - 1.0).abs() < 0.005, "{here} {there}");
}

/// Uniform traffic of `load` flits a cycle and node until a cycle: a Bernoulli process at each node.
fn traffic(load: f64, until: u64, seed: u64) -> Vec<TraceMessage> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let threshold = (load / FLITS as f64 * 2_f64.powi(64)) as u64;
    let mut packets = Vec::new();
    for cycle in 0..until {
        for from in 0..NODES {
            if random.next_u64() < threshold {
                let to = (random.next_u64() >> 58) as usize;
                packets.push(packet(cycle, from, to));
            }
        }
    }
    packets
}

/// Mean latency of the packets generated in cycles 5,000 to 25,000, without those that meet an empty network.
fn mean_latency(network: &NetworkParameters, load: f64, seed: u64) -> f64 {
    let packets = cycles(network, traffic(load, 30_000, seed)).into_iter();
    let judged = packets.filter(|(generated, _)| (5_000..25_000).contains(generated));
    let latencies: Vec<u64> = judged.map(|(generated, arrived)| arrived - generated).collect();
    latencies.iter().sum::<u64>() as f64 / latencies.len() as f64
}

/// Load, `vc_buf_size`, and the mean latency of 16 runs of BookSim2 with `routing_delay` 0, of packets generated in
/// the same 20,000 cycles, with the standard deviation of a run.
const LOADED: [(f64, u32, f64, f64); 6] = [
    (0.12, 8, 57.31, 0.67),
    (0.16, 8, 68.27, 1.35),
    (0.20, 8, 103.59, 5.66),
    (0.12, 16, 55.90, 0.40),
    (0.16, 16, 62.80, 0.82),
    (0.20, 16, 74.62, 1.76),
];

#[test]
fn packets_under_load_take_booksims_latency() {
    const RUNS: u64 = 4;
    for (load, vc_buf_size, mean, deviation) in LOADED {
        let network = booksim(0, vc_buf_size);
        let runs = (0..RUNS).map(|seed| mean_latency(&network, load, seed));
        let found = runs.sum::<f64>() / RUNS as f64;
        // Three standard errors of the difference of both means.
        let tolerance = 3.0 * deviation * (1.0 / 16.0 + 1.0 / RUNS as f64).sqrt();
        assert!((found - mean).abs() < tolerance, "{load} {vc_buf_size}: {found}, not {mean}");
    }
}

/// `routing_delay`, `vc_buf_size`, and the flits a cycle and node that arrive in cycles 5,000 to 20,000 of 8 runs of
/// BookSim2 at an offered load of 0.4, with the standard deviation of a run.
const SATURATED: [(u64, u32, f64, f64); 4] = [
    (0, 8, 0.2380, 0.0020),
    (1, 8, 0.2266, 0.0018),
    (0, 16, 0.2731, 0.0016),
    (1, 16, 0.2602, 0.0028),
];

#[test]
fn flit_saturates_where_booksim_does() {
    for (routing_delay, vc_buf_size, mean, deviation) in SATURATED {
        let network = booksim(routing_delay, vc_buf_size);
        let packets = cycles(&network, traffic(0.4, 20_000, 1)).into_iter();
        let arrived = packets.filter(|(_, arrived)| (5_000..20_000).contains(arrived)).count();
        let found = arrived as f64 * FLITS as f64 / (NODES as f64 * 15_000.0);
        // Three standard errors of the difference of a run and a mean of 8.
        let tolerance = 3.0 * deviation * (1.0_f64 + 1.0 / 8.0).sqrt();
        let what = format!("{routing_delay} {vc_buf_size}");
        assert!((found - mean).abs() < tolerance, "{what}: {found}, not {mean}");
    }
}
