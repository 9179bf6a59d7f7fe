//! The network: when a message arrives and what it costs the processors at both ends.
//!
//! A ladder of models behind one trait. The first rungs know no contention; a rung that does would
//! keep the state of [`crate::Mesh`]'s links between deliveries.

mod ideal;
mod loggp;

use desim::{Duration, Time};

pub use ideal::Ideal;
pub use loggp::{LogGp, LogGpParameters};

use crate::mesh::{Mesh, Place};

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

/// Which network a machine has.
#[derive(Clone, Debug, PartialEq)]
pub enum NetworkModel {
    /// LogGP with hops.
    LogGp(LogGpParameters),
    /// Messages cost nothing.
    Ideal,
}

impl NetworkModel {
    /// A network of this model, with nothing under way.
    pub fn build(&self, mesh: &Mesh) -> Box<dyn Network> {
        match self {
            NetworkModel::LogGp(parameters) => Box::new(LogGp::new(parameters.clone(), mesh)),
            NetworkModel::Ideal => Box::new(Ideal),
        }
    }
}
