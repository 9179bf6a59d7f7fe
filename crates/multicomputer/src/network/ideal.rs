//! The model `ideal`: messages cost nothing. It shows how much of a run's time is not due to the network.

use desim::{Duration, Time};

use super::formula::{Delivery, Formula};
use super::message::Message;

/// Messages arrive at once and cost nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Ideal;

impl Formula for Ideal {
    fn deliver(&mut self, now: Time, _: &Message) -> Delivery {
        Delivery { sender_free: now, arrives: now, stall: None }
    }

    fn receive_overhead(&self) -> Duration {
        Duration::ZERO
    }
}
