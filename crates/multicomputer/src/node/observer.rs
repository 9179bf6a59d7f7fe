//! Who is told what happens on a running machine, as it happens.

use desim::Time;

use super::account::Activity;
use super::buffers::Rank;
use crate::network::Stall;

/// Told what happens on a [`crate::Multicomputer`], in the order of virtual time. It changes nothing:
/// a machine that nobody observes runs the same.
pub trait MachineObserver<M> {
    /// A node has done one thing for a while. Spans follow each other without gap or overlap, from
    /// the start until the node has finished; those of no length are not told.
    fn activity(&mut self, rank: Rank, activity: Activity, from: Time, to: Time);

    /// A message goes onto the network.
    fn sent(&mut self, now: Time, message: Sent<'_, M>);

    /// The message of this number has come to the node of rank `to`; by its way other messages held
    /// it up.
    fn arrived(&mut self, now: Time, to: Rank, number: u64, stalls: &[Stall]);

    /// A process takes the messages that came to it first of those that it has not read, so many.
    fn read(&mut self, now: Time, rank: Rank, count: usize);
}

/// A message as it goes onto the network.
#[derive(Clone, Copy, Debug)]
pub struct Sent<'a, M> {
    /// How many went before it.
    pub number: u64,
    /// Who sends it.
    pub from: Rank,
    /// Who is to get it.
    pub to: Rank,
    /// Its length.
    pub bytes: u64,
    /// Whether a coprocessor sends it, to which the processor has handed it over.
    pub handed_over: bool,
    /// What it says.
    pub message: &'a M,
}
