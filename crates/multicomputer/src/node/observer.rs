//! The interface for observers of a running machine.

use desim::Time;

use super::account::Activity;
use super::envelope::Rank;
use crate::network::Stall;

/// Receives the events of a [`crate::Multicomputer`] in the order of virtual time. It does not change the
/// run.
pub trait MachineObserver<M> {
    /// A node has ended a span of one activity. The spans of a node follow each other without gap or
    /// overlap from the start until it has finished; empty spans are left out.
    fn activity(&mut self, rank: Rank, activity: Activity, from: Time, to: Time);

    /// A message enters the network.
    fn sent(&mut self, now: Time, message: Sent<'_, M>);

    /// Message `number` has arrived at the node of rank `to`; `stalls` are its waits for other messages
    /// on the way.
    fn arrived(&mut self, now: Time, to: Rank, number: u64, stalls: &[Stall]);

    /// A process reads the first `count` messages of its mailbox.
    fn read(&mut self, now: Time, rank: Rank, count: usize);
}

/// A message that enters the network.
#[derive(Clone, Copy, Debug)]
pub struct Sent<'a, M> {
    /// How many messages entered the network before it.
    pub number: u64,
    /// The sender.
    pub from: Rank,
    /// The receiver.
    pub to: Rank,
    /// Its length in bytes.
    pub bytes: u64,
    /// Whether a coprocessor sends it.
    pub handed_over: bool,
    /// Its contents.
    pub message: &'a M,
}
