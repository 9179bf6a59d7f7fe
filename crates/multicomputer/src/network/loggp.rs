//! The model `loggp`: overhead, latency, gap, gap per byte, and hops, without contention.
//!
//! Alexandrov, Ionescu, Schauser, Scheiman: LogGP, SPAA 1995. A message of n bytes takes
//!
//! ```text
//! sender    |-- o --|
//! port              |-- n G --|-- g --|      (not before it is free of the last message)
//! network                     |-- L + hops h --|
//! receiver                                     |-- o --|
//! ```
//!
//! A node's port works independently, like the message processor of a Paragon's node: a sender is free
//! after its overhead even if the port is still busy with earlier messages.

use desim::{Duration, Time};

use super::channel::Channel;
use super::formula::{Delivery, Formula};
use super::message::Message;
use super::network::Stall;
use super::topology::Topology;

/// Parameters of the model.
#[derive(Clone, Debug, PartialEq)]
pub struct LogGpParameters {
    /// o at the sender.
    pub send_overhead: Duration,
    /// L, without hops.
    pub latency: Duration,
    /// h: from router to router.
    pub hop_time: Duration,
    /// o at the receiver.
    pub receive_overhead: Duration,
    /// g: from the end of one injection to the start of the next.
    pub gap: Duration,
    /// 1/G: bytes a second.
    pub bandwidth: f64,
}

impl LogGpParameters {
    /// G n: time in which a node's port injects a message.
    pub(crate) fn injection(&self, bytes: u64) -> Duration {
        Duration::from_seconds_f64(bytes as f64 / self.bandwidth)
    }

    /// The bare network: a message layer without cost, over links of this bandwidth.
    pub fn bare(hop_time: Duration, bandwidth: f64) -> LogGpParameters {
        let (send_overhead, latency) = (Duration::ZERO, Duration::ZERO);
        let (receive_overhead, gap) = (Duration::ZERO, Duration::ZERO);
        LogGpParameters { send_overhead, latency, hop_time, receive_overhead, gap, bandwidth }
    }

    /// The closed formula: time from the send of a message of `bytes`, alone on the network, until it
    /// has been read `hops` links away.
    pub fn one_way(&self, bytes: u64, hops: u32) -> Duration {
        let way = self.latency + self.hop_time * u64::from(hops);
        self.send_overhead + self.injection(bytes) + way + self.receive_overhead
    }
}

/// LogGP on a topology.
pub struct LogGp {
    parameters: LogGpParameters,
    topology: Topology,
    ports: Vec<Port>,
}

/// A node's port.
#[derive(Clone, Copy, Default)]
struct Port {
    /// When it can inject the next message.
    free: Time,
    /// Id of the last message.
    last: u64,
}

impl LogGp {
    /// An empty network.
    pub fn new(parameters: LogGpParameters, topology: &Topology) -> LogGp {
        let ports = vec![Port::default(); topology.places()];
        LogGp { parameters, topology: topology.clone(), ports }
    }
}

impl Formula for LogGp {
    fn deliver(&mut self, now: Time, message: &Message) -> Delivery {
        let Message { id, from, to, bytes } = *message;
        let port = &mut self.ports[from.index()];
        let sender_free = now + self.parameters.send_overhead;
        let wait = port.free - sender_free;
        let injected = sender_free + wait + self.parameters.injection(bytes);
        let channel = Channel::Injection(from);
        let stall = (wait > Duration::ZERO).then_some(Stall { channel, by: port.last, span: wait });
        *port = Port { free: injected + self.parameters.gap, last: id };
        let hops = u64::from(self.topology.hops(from, to));
        let arrives = injected + self.parameters.latency + self.parameters.hop_time * hops;
        Delivery { sender_free, arrives, stall }
    }

    fn receive_overhead(&self) -> Duration {
        self.parameters.receive_overhead
    }
}
