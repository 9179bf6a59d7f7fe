//! How a message travels.

use desim::{Duration, Time};

use crate::mesh::Place;

/// How messages travel.
pub trait Network {
    /// Takes a message whose send begins `now`. Called in the order of virtual time. Messages
    /// between the same two places must arrive in the order in which they are given.
    fn deliver(&mut self, now: Time, from: Place, to: Place, bytes: u64) -> Delivery;

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
}
