//! Replays a trace over a network: when each message was sent and arrived, and what blocked it.

use desim::{Duration, EventQueue, Time};
use thiserror::Error;

use super::dependencies::Dependencies;
use super::trace::{Trace, TraceMessage};
use crate::network::{Arrival, Deadlock, Message, Network, Place, Stall, Topology};

/// The times of one message of a trace.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ReplayedMessage {
    /// When its sender's processor began to send it.
    pub sent: Time,
    /// When its receiver's processor has read it.
    pub arrived: Time,
    /// Its waits for other messages, which are named by their indices in the trace.
    pub stalls: Vec<Stall>,
}

impl ReplayedMessage {
    /// Total time that it waited for other messages on the network.
    pub fn blocked(&self) -> Duration {
        self.stalls.iter().map(|stall| stall.span).sum()
    }

    /// Indices of the messages that it waited for, in order, each once.
    pub fn blockers(&self) -> Vec<usize> {
        let mut blockers = Vec::new();
        for by in self.stalls.iter().map(|stall| stall.by as usize) {
            if !blockers.contains(&by) {
                blockers.push(by);
            }
        }
        blockers
    }
}

/// A replay that ends in a deadlock.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("at {at}: {text}")]
pub struct ReplayDeadlock {
    /// Time of the deadlock.
    pub at: Time,
    /// The circle; messages are named by their indices in the trace.
    pub deadlock: Deadlock,
    text: String,
}

/// Sends a trace over a network. Returns the times of each message, in the trace's order.
///
/// A node's processor does one thing at a time: it sends a message until the network says that it is
/// free, and reads a message for the receive overhead. Node i is at place i.
///
/// # Errors
/// [`ReplayDeadlock`] if messages wait for each other in a circle.
pub fn replay(
    trace: &Trace,
    network: &mut dyn Network,
    topology: &Topology,
) -> Result<Vec<ReplayedMessage>, ReplayDeadlock> {
    let mut replay = Replay::new(trace, topology.places());
    let mut arrived = Vec::new();
    loop {
        let next = [replay.due.next_time(), network.next_event()].into_iter().flatten().min();
        let Some(now) = next else { return Ok(replay.results) };
        network.advance(now, &mut arrived).map_err(|deadlock| {
            let name =
                |message: &Message| format!("\"{}\"", trace.messages[message.id as usize].name);
            ReplayDeadlock { at: now, text: deadlock.describe(name), deadlock }
        })?;
        for arrival in arrived.drain(..) {
            replay.read(arrival, network.receive_overhead());
        }
        while let Some((_, index)) = replay.due.take_due(now) {
            replay.send(index, now, network);
        }
    }
}

struct Replay<'a> {
    messages: &'a [TraceMessage],
    results: Vec<ReplayedMessage>,
    /// Messages that can be sent, by time.
    due: EventQueue<usize>,
    /// Which messages wait for which.
    dependencies: Dependencies,
    /// When each node's processor is free.
    free: Vec<Time>,
}

impl Replay<'_> {
    fn new(trace: &Trace, places: usize) -> Replay<'_> {
        let messages = &trace.messages;
        let mut replay = Replay {
            messages,
            results: vec![ReplayedMessage::default(); messages.len()],
            due: EventQueue::default(),
            dependencies: Dependencies::of(messages.iter().map(|message| &message.after)),
            free: vec![Time::ZERO; places],
        };
        for (index, message) in messages.iter().enumerate() {
            if !replay.dependencies.waits(index) {
                replay.due.schedule(message.at, index);
            }
        }
        replay
    }

    /// A message is due: it is sent, or waits until its node's processor is free.
    fn send(&mut self, index: usize, now: Time, network: &mut dyn Network) {
        let &TraceMessage { from, to, bytes, .. } = &self.messages[index];
        if self.free[from] > now {
            return self.due.schedule(self.free[from], index);
        }
        let [from_place, to] = [from, to].map(Place::new);
        let message = Message { id: index as u64, from: from_place, to, bytes };
        self.free[from] = network.send(now, message);
        self.results[index].sent = now;
    }

    /// A message has arrived and is read, which may allow others to be sent.
    fn read(&mut self, arrival: Arrival, overhead: Duration) {
        let index = arrival.message.id as usize;
        let free = &mut self.free[arrival.message.to.index()];
        *free = arrival.at.max(*free) + overhead;
        self.results[index].arrived = *free;
        self.results[index].stalls = arrival.stalls;
        for follower in self.dependencies.end(index) {
            self.due.schedule(self.messages[follower].at.max(*free), follower);
        }
    }
}
