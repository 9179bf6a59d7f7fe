//! The network with the contents of the messages in flight.

use std::collections::VecDeque;
use std::mem;

use desim::Time;

use super::envelope::{Envelope, Rank};
use crate::network::{Arrival, Deadlock, Message, Network, Place};

/// The network, which sees places and lengths, and the contents of the messages in flight.
pub(crate) struct Transport<M> {
    pub(crate) network: Box<dyn Network>,
    /// Receivers and contents of messages, in the order of sending: message i has the index
    /// i - `first`. None for one that has arrived.
    in_flight: VecDeque<Option<(Rank, M)>>,
    /// Number of the first of them.
    first: u64,
    arrived: Vec<Arrival>,
    /// The deadlock that has stopped the network.
    pub(crate) deadlock: Option<Deadlock>,
}

impl<M> Transport<M> {
    pub(crate) fn new(network: Box<dyn Network>) -> Transport<M> {
        let (in_flight, arrived) = (VecDeque::new(), Vec::new());
        Transport { network, in_flight, first: 0, arrived, deadlock: None }
    }

    /// How many messages have been sent.
    pub(crate) fn sent(&self) -> u64 {
        self.first + self.in_flight.len() as u64
    }

    /// Sends a message. Returns when the sending processor is free.
    pub(crate) fn send(
        &mut self,
        now: Time,
        (from, to): (Place, Place),
        envelope: Envelope<M>,
    ) -> Time {
        let id = self.sent();
        self.in_flight.push_back(Some((envelope.to, envelope.message)));
        self.network.send(now, Message { id, from, to, bytes: envelope.bytes })
    }

    /// Advances the network to `now`. Returns what has arrived; give the list back to
    /// [`Transport::recycle`].
    pub(crate) fn advance(&mut self, now: Time) -> Vec<Arrival> {
        let mut arrived = mem::take(&mut self.arrived);
        if let Err(deadlock) = self.network.advance(now, &mut arrived) {
            self.deadlock = Some(deadlock);
        }
        arrived
    }

    /// Keeps an empty list for the next call, which then allocates nothing.
    pub(crate) fn recycle(&mut self, arrived: Vec<Arrival>) {
        self.arrived = arrived;
    }

    /// Receiver and contents of a message that has arrived.
    pub(crate) fn take(&mut self, id: u64) -> Option<(Rank, M)> {
        let taken = self.in_flight.get_mut(id.checked_sub(self.first)? as usize)?.take();
        while let Some(None) = self.in_flight.front() {
            self.in_flight.pop_front();
            self.first += 1;
        }
        taken
    }
}
