//! Synthetic traffic: the patterns with which networks are compared.

use desim::{Duration, Time};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use super::replay::ReplayedMessage;
use super::trace::{Trace, TraceMessage};
use crate::network::{LinkParameters, Place, Topology};

/// Which nodes send to which.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pattern {
    /// To any other node.
    Uniform,
    /// To any neighbour on the network, or the nodes with the next numbers if there are none.
    Neighbour,
    /// From column x, row y to column y, row x. Nodes without such a partner do not send.
    Transpose,
    /// One message of five to the middle node, the others to any other node.
    HotSpot,
    /// To the middle node.
    AllToOne,
}

impl Pattern {
    /// All patterns.
    pub const ALL: [Pattern; 5] = [
        Pattern::Uniform,
        Pattern::Neighbour,
        Pattern::Transpose,
        Pattern::HotSpot,
        Pattern::AllToOne,
    ];

    /// Its name in tables and arguments.
    pub fn name(self) -> &'static str {
        match self {
            Pattern::Uniform => "uniform",
            Pattern::Neighbour => "neighbour",
            Pattern::Transpose => "transpose",
            Pattern::HotSpot => "hot-spot",
            Pattern::AllToOne => "all-to-one",
        }
    }

    /// The possible receivers of a node, all equally likely; repeated ones are more likely. If the node
    /// itself is among them, it sends nothing in that case.
    fn partners(self, topology: &Topology, nodes: usize, from: usize) -> Vec<usize> {
        let middle = nodes / 2;
        let others = || (0..nodes).filter(move |&to| to != from);
        match self {
            Pattern::Uniform => others().collect(),
            Pattern::AllToOne => vec![middle],
            Pattern::HotSpot => {
                let many = std::iter::repeat_n(middle, (nodes - 1).div_ceil(4));
                others().chain(many).collect()
            }
            Pattern::Transpose => {
                let position = topology.position(Place::new(from));
                let is_partner = |&to: &usize| {
                    let other = topology.position(Place::new(to));
                    (other.x, other.y) == (position.y, position.x)
                };
                (0..nodes).filter(is_partner).collect()
            }
            Pattern::Neighbour => {
                let near = |&to: &usize| topology.hops(Place::new(from), Place::new(to)) == 1;
                let near: Vec<usize> = others().filter(near).collect();
                match near.is_empty() {
                    true => vec![(from + 1) % nodes, (from + nodes - 1) % nodes],
                    false => near,
                }
            }
        }
    }
}

/// Upper bound of the bytes a second that every node can send: at this rate one channel is fully used.
/// A network with finite buffers saturates earlier.
pub fn fluid_bound(
    pattern: Pattern,
    topology: &Topology,
    nodes: usize,
    links: &LinkParameters,
) -> f64 {
    // Each channel's share of what a node sends, added over all nodes.
    let mut shares = vec![0.0; topology.graph().edge_count()];
    let mut outs = vec![0.0; nodes];
    for from in 0..nodes {
        let partners = pattern.partners(topology, nodes, from);
        let share = 1.0 / partners.len() as f64;
        for to in partners.into_iter().filter(|&to| to != from) {
            outs[to] += share;
            for hop in topology.route(Place::new(from), Place::new(to)) {
                shares[hop.link.index()] += share;
            }
        }
    }
    links.bandwidth / shares.into_iter().chain(outs).fold(1.0, f64::max)
}

/// A load of synthetic traffic. Every node sends messages of one size at random times (a Poisson
/// process).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    /// Which nodes send to which.
    pub pattern: Pattern,
    /// Bytes a message.
    pub bytes: u64,
    /// Mean time between two messages of a node.
    pub every: Duration,
    /// Until when messages are sent.
    pub until: Time,
    /// Seed of the random choices.
    pub seed: u64,
}

impl Load {
    /// The traffic among the first `nodes` nodes, in order of time.
    pub fn trace(&self, topology: &Topology, nodes: usize) -> Trace {
        let mut messages = Vec::new();
        for from in 0..nodes {
            let mut random = ChaCha8Rng::seed_from_u64(self.seed);
            random.set_stream(from as u64);
            let partners = self.pattern.partners(topology, nodes, from);
            let mut at = Time::ZERO + self.gap(&mut random);
            while at < self.until && !partners.is_empty() {
                let to = partners[below(partners.len(), random.next_u64())];
                if to != from {
                    let (name, bytes) = (String::new(), self.bytes);
                    messages.push(TraceMessage { name, at, from, to, bytes, after: Vec::new() });
                }
                at += self.gap(&mut random);
            }
        }
        messages.sort_by_key(|message| message.at);
        for (number, message) in messages.iter_mut().enumerate() {
            message.name = number.to_string();
        }
        Trace { messages }
    }

    /// A random time until the next message, exponentially distributed.
    fn gap(&self, random: &mut ChaCha8Rng) -> Duration {
        // In (0, 1]: its logarithm is finite.
        let share = ((random.next_u64() >> 11) + 1) as f64 / (1_u64 << 53) as f64;
        let seconds = -libm::log(share) * self.every.as_seconds_f64();
        Duration::from_seconds_f64(seconds)
    }
}

/// A uniform number below `count`, from a uniform `random`.
fn below(count: usize, random: u64) -> usize {
    ((u128::from(random) * count as u128) >> 64) as usize
}

/// The steady state of a load: without the time in which the network fills and empties.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Measured {
    /// Messages sent between a quarter of the time and its end.
    pub messages: usize,
    /// Mean time of these from when they were due until they were read, seconds.
    pub latency: f64,
    /// Bytes that arrived in that time, a second, over all nodes.
    pub throughput: f64,
}

impl Measured {
    /// Measures a load from the times of its messages.
    pub fn of(load: &Load, trace: &Trace, replayed: &[ReplayedMessage]) -> Measured {
        let from = Time(load.until.0 / 4);
        let both = || trace.messages.iter().zip(replayed);
        let latencies: Vec<f64> = both()
            .filter(|(message, _)| message.at >= from)
            .map(|(message, times)| (times.arrived - message.at).as_seconds_f64())
            .collect();
        let arrived = both().filter(|(_, times)| (from..load.until).contains(&times.arrived));
        let bytes: u64 = arrived.map(|(message, _)| message.bytes).sum();
        Measured {
            messages: latencies.len(),
            latency: latencies.iter().sum::<f64>() / latencies.len().max(1) as f64,
            throughput: bytes as f64 / (load.until - from).as_seconds_f64(),
        }
    }
}
