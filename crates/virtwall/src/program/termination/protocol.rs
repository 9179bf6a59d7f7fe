//! A termination protocol as a state machine: events in, one action out. It knows no process and no network.

use crate::problem::Rank;

/// One compute node's part in a protocol.
pub(crate) trait Termination: Send {
    /// This node sends a source to another.
    fn source_sent(&mut self);

    /// The token arrives.
    fn token_arrived(&mut self, value: bool);

    /// This node has nothing to compute: what it does now.
    fn idle(&mut self) -> Action;
}

/// What a node with nothing to compute does.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Action {
    /// Wait for a message.
    Wait,
    /// Send the token with this value.
    Send(Rank, bool),
    /// Announce the end to all processes.
    Announce,
}
