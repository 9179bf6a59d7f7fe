//! Networks without contention: when a message arrives is known when it is sent.

use desim::{Duration, Time};

use super::agenda::Agenda;
use super::deadlock::Deadlock;
use super::message::Message;
use super::network::{Arrival, Network, Stall};

/// A closed formula for the course of a message.
pub trait Formula {
    /// The course of a message whose send begins `now`. Called in the order of virtual time.
    /// Messages between the same two places must arrive in the order in which they are given.
    fn deliver(&mut self, now: Time, message: &Message) -> Delivery;

    /// What taking one message costs the processor that receives it.
    fn receive_overhead(&self) -> Duration;
}

/// The course of one message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Delivery {
    /// When the sending processor may go on; until then it is busy with the message.
    pub sender_free: Time,
    /// When the message stands in the receiver's mailbox.
    pub arrives: Time,
    /// How long it waits for the sender's port, if it does.
    pub stall: Option<Stall>,
}

/// A network that follows a formula.
#[derive(Default)]
pub struct ContentionFree<F> {
    formula: F,
    arrivals: Agenda<(Message, Option<Stall>)>,
}

impl<F: Formula> ContentionFree<F> {
    /// A network with nothing under way.
    pub fn new(formula: F) -> ContentionFree<F> {
        ContentionFree { formula, arrivals: Agenda::default() }
    }
}

impl<F: Formula> Network for ContentionFree<F> {
    fn send(&mut self, now: Time, message: Message) -> Time {
        let Delivery { sender_free, arrives, stall } = self.formula.deliver(now, &message);
        self.arrivals.enter(arrives, (message, stall));
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
