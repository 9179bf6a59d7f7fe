//! The model `loggp`: overhead, latency, gap, gap per byte, and hops, without contention for links.
//!
//! Alexandrov, Ionescu, Schauser, Scheiman: LogGP, SPAA 1995. A message of n bytes takes
//!
//! ```text
//! sender    |-- o --|
//! its port          |-- n G --|-- g --|        (not before it is free of the last message)
//! network           |-- L + hops h --|
//! receiving port                     |-- n G --|-- g --|     (not before it is free, first come first served)
//! receiver                                     |-- o --|
//! ```
//!
//! A node's port works independently, like the message processor of a Paragon's node: a sender is free
//! after its overhead even if the port is still busy with earlier messages. It sends and receives at the same
//! time. The gaps hold at both ends, as the model's authors and LogGOPSim have it: several senders to one node
//! share its port.

use desim::{Duration, EventQueue, Time};

use super::channel::Channel;
use super::deadlock::Deadlock;
use super::message::Message;
use super::network::{Arrival, Network, Stall};
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
    /// By place, as senders and as receivers.
    ports: Vec<[Port; 2]>,
    events: EventQueue<Event>,
}

/// One direction of a node's port.
#[derive(Clone, Copy, Default)]
struct Port {
    /// When it can begin with the next message.
    free: Time,
    /// Id of the last message.
    last: u64,
}

enum Event {
    /// The first byte of a message is at the receiver's port.
    Head(Message, Vec<Stall>),
    /// The message is in the receiver's mailbox.
    Arrival(Arrival),
}

impl LogGp {
    /// An empty network.
    pub fn new(parameters: LogGpParameters, topology: &Topology) -> LogGp {
        let ports = vec![<[Port; 2]>::default(); topology.places()];
        LogGp { parameters, topology: topology.clone(), ports, events: EventQueue::default() }
    }

    /// Pass a message through a port. Returns when its first byte does, and adds its wait to `stalls`.
    fn pass(
        &mut self,
        now: Time,
        message: &Message,
        channel: Channel,
        stalls: &mut Vec<Stall>,
    ) -> Time {
        let port = match channel {
            Channel::Ejection(place) => &mut self.ports[place.index()][1],
            _ => &mut self.ports[message.from.index()][0],
        };
        let wait = port.free - now;
        if wait > Duration::ZERO {
            stalls.push(Stall { channel, by: port.last, span: wait });
        }
        let (start, span) = (now + wait, self.parameters.injection(message.bytes));
        *port = Port { free: start + span + self.parameters.gap, last: message.id };
        start
    }

    /// A message reaches its receiver's port.
    fn receive(&mut self, head: Time, message: Message, mut stalls: Vec<Stall>) {
        let channel = Channel::Ejection(message.to);
        let start = self.pass(head, &message, channel, &mut stalls);
        let at = start + self.parameters.injection(message.bytes);
        self.events.schedule(at, Event::Arrival(Arrival { message, at, stalls }));
    }
}

impl Network for LogGp {
    fn send(&mut self, now: Time, message: Message) -> Time {
        let sender_free = now + self.parameters.send_overhead;
        let mut stalls = Vec::new();
        let channel = Channel::Injection(message.from);
        let first = self.pass(sender_free, &message, channel, &mut stalls);
        let hops = u64::from(self.topology.hops(message.from, message.to));
        let way = self.parameters.latency + self.parameters.hop_time * hops;
        self.events.schedule(first + way, Event::Head(message, stalls));
        sender_free
    }

    fn receive_overhead(&self) -> Duration {
        self.parameters.receive_overhead
    }

    fn next_event(&self) -> Option<Time> {
        self.events.next_time()
    }

    fn advance(&mut self, now: Time, arrived: &mut Vec<Arrival>) -> Result<(), Deadlock> {
        while let Some((at, event)) = self.events.take_due(now) {
            match event {
                Event::Head(message, stalls) => self.receive(at, message, stalls),
                Event::Arrival(arrival) => arrived.push(arrival),
            }
        }
        Ok(())
    }
}
