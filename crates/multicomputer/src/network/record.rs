//! What went over a network in a run, written down as it went.

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
    /// In the order in which they were sent.
    pub messages: Vec<RecordedMessage>,
    /// What reading each cost its receiver.
    pub receive_overhead: Duration,
}

/// A message of the past.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RecordedMessage {
    /// When it was sent.
    pub at: Time,
    /// How long that kept its sender busy.
    pub sender_busy: Duration,
    /// Where it was sent.
    pub from: Place,
    /// Where it went.
    pub to: Place,
    /// Its length.
    pub bytes: u64,
    /// When it arrived, if it did.
    pub arrived: Option<Time>,
    /// How long other messages held it up.
    pub blocked: Duration,
}

impl Record {
    /// How long messages held each other up, in all.
    pub fn blocked(&self) -> Duration {
        self.messages.iter().map(|message| message.blocked).sum()
    }

    /// The part of the time until `end` in which the link that was used most carried bytes; above 1
    /// if there was more for it than it could have carried. Other channels do not count.
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

/// A network that writes down what goes over it.
pub struct Recorder {
    network: Box<dyn Network>,
    record: Rc<RefCell<Record>>,
    /// Messages under way, by their senders' names for them.
    under_way: BTreeMap<u64, usize>,
}

impl Recorder {
    /// The network, and where its messages will be written down.
    pub fn new(network: Box<dyn Network>) -> (Recorder, Rc<RefCell<Record>>) {
        let receive_overhead = network.receive_overhead();
        let record = Record { messages: Vec::new(), receive_overhead };
        let record = Rc::new(RefCell::new(record));
        let under_way = BTreeMap::new();
        (Recorder { network, record: Rc::clone(&record), under_way }, record)
    }
}

impl Network for Recorder {
    fn send(&mut self, now: Time, message: Message) -> Time {
        let sender_free = self.network.send(now, message);
        let messages = &mut self.record.borrow_mut().messages;
        self.under_way.insert(message.id, messages.len());
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
            let message = self.under_way.remove(&message.id).and_then(|i| messages.get_mut(i));
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
