//! Shots and messages of compute nodes, counted.

use std::ops::AddAssign;

/// Shots and messages of a compute node, or of all together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Shots of patches in their own environment.
    pub local_shots: u64,
    /// Shots of sources handed on from another environment, of the same processor or not.
    pub received_shots: u64,
    /// Sources sent from processor to processor.
    pub messages: u64,
    /// Their bytes.
    pub message_bytes: u64,
    /// Radiosity updates sent to the service node.
    pub update_messages: u64,
    /// Their bytes.
    pub update_bytes: u64,
    /// Messages for collection and termination.
    pub control_messages: u64,
}

impl AddAssign for Counts {
    fn add_assign(&mut self, other: Counts) {
        self.local_shots += other.local_shots;
        self.received_shots += other.received_shots;
        self.messages += other.messages;
        self.message_bytes += other.message_bytes;
        self.update_messages += other.update_messages;
        self.update_bytes += other.update_bytes;
        self.control_messages += other.control_messages;
    }
}
