//! Models without contention: the time of arrival is known when a message is sent.

use desim::{Duration, EventQueue, Time};

use super::deadlock::Deadlock;
use super::message::Message;
use super::network::{Arrival, Network, Stall};

/// A closed formula for the times of a message.
pub trait Formula {
    /// The times of a message whose send begins `now`. Called in the order of virtual time.
    /// Messages between the same two places must arrive in the order of the calls.
    fn deliver(&mut self, now: Time, message: &Message) -> Delivery;

    /// Time that the receiving processor spends on a message.
    fn receive_overhead(&self) -> Duration;
}

/// The times of one message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Delivery {
    /// When the sending processor is free.
    pub sender_free: Time,
    /// When the message arrives in the receiver's mailbox.
    pub arrives: Time,
    /// Its wait for the sender's port, if it has to wait.
    pub stall: Option<Stall>,
}

/// A network without contention, whose messages follow a formula.
#[derive(Default)]
pub struct ContentionFree<F> {
    formula: F,
    arrivals: EventQueue<(Message, Option<Stall>)>,
}

impl<F: Formula> ContentionFree<F> {
    /// An empty network.
    pub fn new(formula: F) -> ContentionFree<F> {
        ContentionFree { formula, arrivals: EventQueue::default() }
    }
}

impl<F: Formula> Network for ContentionFree<F> {
    fn send(&mut self, now: Time, message: Message) -> Time {
        let Delivery { sender_free, arrives, stall } = self.formula.deliver(now, &message);
        self.arrivals.schedule(arrives, (message, stall));
        sender_free
    }

    fn receive_overhead(&self) -> Duration {
        self.formula.receive_overhead()
    }

    fn next_event(&self) -> Option<Time> {
        self.arrivals.next_time()
    }

    fn advance(&mut self, now: Time, arrived: &mut Vec<Arrival>) -> Result<(), Deadlock> {
        while let Some((at, (message, stall))) = self.arrivals.take_due(now) {
            arrived.push(Arrival { message, at, stalls: stall.into_iter().collect() });
        }
        Ok(())
    }
}
