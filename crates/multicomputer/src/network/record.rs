//! A record of all messages of a run.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

use desim::{Duration, Time};

use super::deadlock::Deadlock;
use super::links::LinkParameters;
use super::message::Message;
use super::network::{Arrival, ChannelUse, Network};
use super::topology::{Place, Topology};

/// All messages of a run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Record {
    /// In the order of sending.
    pub messages: Vec<RecordedMessage>,
    /// Time that the receiver spent on each.
    pub receive_overhead: Duration,
}

/// A message that was sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RecordedMessage {
    /// When its send began.
    pub at: Time,
    /// How long the sender was busy with it.
    pub sender_busy: Duration,
    /// The sender's place.
    pub from: Place,
    /// The receiver's place.
    pub to: Place,
    /// Its length in bytes.
    pub bytes: u64,
    /// When it arrived; none if it has not.
    pub arrived: Option<Time>,
    /// How long it waited for other messages on the way.
    pub blocked: Duration,
}

impl Record {
    /// Total time that messages waited for each other.
    pub fn blocked(&self) -> Duration {
        self.messages.iter().map(|message| message.blocked).sum()
    }

    /// Utilisation of the busiest link until `end`; above 1 if its messages exceed its capacity.
    /// Injection and ejection do not count.
    pub fn busiest_link(&self, topology: &Topology, links: &LinkParameters, end: Time) -> f64 {
        let mut busy = vec![0.0; topology.graph().edge_count()];
        let mut bytes: BTreeMap<(Place, Place), u64> = BTreeMap::new();
        for message in &self.messages {
            *bytes.entry((message.from, message.to)).or_default() += message.bytes;
        }
        for ((from, to), bytes) in bytes {
            for hop in topology.route(from, to) {
                busy[hop.link.index()] += bytes as f64 / links.bandwidth;
            }
        }
        let most = busy.into_iter().fold(0.0, f64::max);
        if end > Time::ZERO { most / end.as_seconds_f64() } else { 0.0 }
    }
}

/// A network that records its messages.
pub struct Recorder {
    network: Box<dyn Network>,
    record: Rc<RefCell<Record>>,
    /// Indices of messages in flight, by id.
    in_flight: BTreeMap<u64, usize>,
}

impl Recorder {
    /// Wraps a network. Returns the wrapper and its record.
    pub fn new(network: Box<dyn Network>) -> (Recorder, Rc<RefCell<Record>>) {
        let receive_overhead = network.receive_overhead();
        let record = Record { messages: Vec::new(), receive_overhead };
        let record = Rc::new(RefCell::new(record));
        let in_flight = BTreeMap::new();
        (Recorder { network, record: Rc::clone(&record), in_flight }, record)
    }
}

impl Network for Recorder {
    fn send(&mut self, now: Time, message: Message) -> Time {
        let sender_free = self.network.send(now, message);
        let messages = &mut self.record.borrow_mut().messages;
        self.in_flight.insert(message.id, messages.len());
        messages.push(RecordedMessage {
            at: now,
            sender_busy: sender_free - now,
            from: message.from,
            to: message.to,
            bytes: message.bytes,
            arrived: None,
            blocked: Duration::ZERO,
        });
        sender_free
    }

    fn receive_overhead(&self) -> Duration {
        self.network.receive_overhead()
    }

    fn next_event(&self) -> Option<Time> {
        self.network.next_event()
    }

    fn advance(&mut self, now: Time, arrived: &mut Vec<Arrival>) -> Result<(), Deadlock> {
        let earlier = arrived.len();
        let advanced = self.network.advance(now, arrived);
        let messages = &mut self.record.borrow_mut().messages;
        for Arrival { message, at, stalls } in &arrived[earlier..] {
            let message = self.in_flight.remove(&message.id).and_then(|i| messages.get_mut(i));
            if let Some(message) = message {
                message.arrived = Some(*at);
                message.blocked = stalls.iter().map(|stall| stall.span).sum();
            }
        }
        advanced
    }

    fn channel_use(&self) -> Vec<ChannelUse> {
        self.network.channel_use()
    }
}
