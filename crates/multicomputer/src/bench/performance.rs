//! Performs a schedule over a network: when each operation began and ended.

use std::collections::{BTreeMap, VecDeque};

use desim::{EventQueue, Time};
use thiserror::Error;

use super::dependencies::Dependencies;
use super::replay::ReplayedMessage;
use super::schedule::{Operation, OperationKind, Schedule};
use super::trace::TraceMessage;
use crate::network::{Arrival, Message, Network, Place};

/// Why a schedule does not end.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum StalledSchedule {
    /// Messages wait for each other in the network.
    #[error("at {at}: {text}")]
    Network {
        /// When.
        at: Time,
        /// The messages, in words.
        text: String,
    },
    /// Operations wait for each other.
    #[error(
        "at {at}: {count} operations wait for each other, such as {name}; expected a schedule that ends"
    )]
    Operations {
        /// When the last operation that could end did.
        at: Time,
        /// The number of operations that wait.
        count: usize,
        /// The first of them.
        name: String,
    },
}

/// Performs a schedule on nodes at the first places of a network. Returns its messages, in the order of their
/// sends in the schedule, with their times, and the end of the last operation.
///
/// Of a node's operations that can begin, the one that could begin first does, and the first of the file of
/// several.
///
/// # Errors
/// [`StalledSchedule`] if operations or messages wait for each other.
pub fn perform(
    schedule: &Schedule,
    network: &mut dyn Network,
) -> Result<(Vec<(TraceMessage, ReplayedMessage)>, Time), StalledSchedule> {
    let mut performance = Performance::new(schedule);
    let (mut arrived, mut now) = (Vec::new(), Time::ZERO);
    while let Some(next) =
        [performance.events.next_time(), network.next_event()].into_iter().flatten().min()
    {
        now = next;
        network.advance(now, &mut arrived).map_err(|deadlock| {
            let name = |message: &Message| performance.sender(message.id).name.clone();
            StalledSchedule::Network { at: now, text: deadlock.describe(name) }
        })?;
        arrived.drain(..).for_each(|arrival| performance.arrive(arrival));
        while let Some((_, event)) = performance.events.take_due(now) {
            performance.happen(event, now, network);
        }
    }
    performance.finish(now)
}

#[derive(Clone, Copy)]
enum Event {
    /// All that an operation waits for on its node has ended.
    Ready(usize),
    /// It can begin, if the processor is free.
    Begin(usize),
    End(usize),
}

/// Arrived messages, and receives that are ready, of a sender, a receiver and a tag.
type Mailbox = (VecDeque<usize>, VecDeque<usize>);

struct Performance<'a> {
    operations: &'a [Operation],
    events: EventQueue<Event>,
    dependencies: Dependencies,
    ended: Vec<bool>,
    /// By message, the operation that sends it, and its times.
    messages: Vec<(usize, ReplayedMessage)>,
    mailboxes: BTreeMap<(usize, usize, u32), Mailbox>,
    /// The message of each operation that sends one, and of each that reads one.
    message_of: BTreeMap<usize, usize>,
    /// When each node's processor is free.
    free: Vec<Time>,
}

impl Performance<'_> {
    fn new(schedule: &Schedule) -> Performance<'_> {
        let operations = &schedule.operations;
        let nodes = operations.iter().map(|operation| operation.node + 1).max().unwrap_or(0);
        let mut performance = Performance {
            operations,
            events: EventQueue::default(),
            dependencies: Dependencies::of(operations.iter().map(|operation| &operation.after)),
            ended: vec![false; operations.len()],
            messages: Vec::new(),
            mailboxes: BTreeMap::new(),
            message_of: BTreeMap::new(),
            free: vec![Time::ZERO; nodes],
        };
        for (index, operation) in operations.iter().enumerate() {
            if let OperationKind::Send { .. } = operation.kind {
                performance.message_of.insert(index, performance.messages.len());
                performance.messages.push((index, ReplayedMessage::default()));
            }
            if !performance.dependencies.waits(index) {
                performance.events.schedule(Time::ZERO, Event::Ready(index));
            }
        }
        performance
    }

    /// The operation that sends a message.
    fn sender(&self, message: u64) -> &Operation {
        &self.operations[self.messages[message as usize].0]
    }

    fn happen(&mut self, event: Event, now: Time, network: &mut dyn Network) {
        match event {
            Event::Ready(index) => match self.operations[index].kind {
                OperationKind::Receive { from, tag } => {
                    let key = (from, self.operations[index].node, tag);
                    self.mailboxes.entry(key).or_default().1.push_back(index);
                    self.deliver(key, now);
                }
                _ => self.begin(index, now, network),
            },
            Event::Begin(index) => self.begin(index, now, network),
            Event::End(index) => {
                self.ended[index] = true;
                for follower in self.dependencies.end(index) {
                    self.events.schedule(now, Event::Ready(follower));
                }
            }
        }
    }

    /// Begins an operation, or waits for its node's processor.
    fn begin(&mut self, index: usize, now: Time, network: &mut dyn Network) {
        let Operation { node, kind, .. } = self.operations[index];
        if self.free[node] > now {
            return self.events.schedule(self.free[node], Event::Begin(index));
        }
        let end = match kind {
            OperationKind::Compute(span) => now + span,
            OperationKind::Send { to, bytes, .. } => {
                let [from, to] = [node, to].map(Place::new);
                let number = self.message_of[&index];
                self.messages[number].1.sent = now;
                network.send(now, Message { id: number as u64, from, to, bytes })
            }
            OperationKind::Receive { .. } => {
                let end = now + network.receive_overhead();
                self.messages[self.message_of[&index]].1.arrived = end;
                end
            }
        };
        self.free[node] = end;
        self.events.schedule(end, Event::End(index));
    }

    fn arrive(&mut self, arrival: Arrival) {
        let number = arrival.message.id as usize;
        self.messages[number].1.stalls = arrival.stalls;
        let &Operation { node, kind, .. } = self.sender(arrival.message.id);
        let OperationKind::Send { to, tag, .. } = kind else { return };
        self.mailboxes.entry((node, to, tag)).or_default().0.push_back(number);
        self.deliver((node, to, tag), arrival.at);
    }

    /// Receives that are ready read messages that have arrived.
    fn deliver(&mut self, key: (usize, usize, u32), now: Time) {
        let (arrived, ready) = self.mailboxes.entry(key).or_default();
        while !arrived.is_empty()
            && let Some(receive) = ready.pop_front()
        {
            self.message_of.extend(arrived.pop_front().map(|message| (receive, message)));
            self.events.schedule(now, Event::Begin(receive));
        }
    }

    fn finish(
        self,
        end: Time,
    ) -> Result<(Vec<(TraceMessage, ReplayedMessage)>, Time), StalledSchedule> {
        let mut waiting = self.operations.iter().zip(&self.ended).filter(|(_, ended)| !**ended);
        if let Some((operation, _)) = waiting.next() {
            let (count, name) = (waiting.count() + 1, operation.name.clone());
            return Err(StalledSchedule::Operations { at: end, count, name });
        }
        let messages = self.messages.into_iter().filter_map(|(index, times)| {
            let Operation { name, node, kind, .. } = &self.operations[index];
            let OperationKind::Send { to, bytes, .. } = *kind else { return None };
            let (name, at, from) = (name.clone(), times.sent, *node);
            Some((TraceMessage { name, at, from, to, bytes, after: Vec::new() }, times))
        });
        Ok((messages.collect(), end))
    }
}
