//! A schedule: what each node computes, sends and receives, and in which order.

use desim::Duration;

/// The operations of all nodes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Schedule {
    /// In the order of the file.
    pub operations: Vec<Operation>,
}

/// An operation of a node. A node's processor does one at a time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Operation {
    /// Its name: rank and label.
    pub name: String,
    /// The node that does it.
    pub node: usize,
    /// What it does.
    pub kind: OperationKind,
    /// Indices of operations of the same node that must have ended before it begins.
    pub after: Vec<usize>,
}

/// What an operation does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OperationKind {
    /// Computes for a time.
    Compute(Duration),
    /// Sends a message; ends when the processor is free again.
    Send {
        /// The receiver.
        to: usize,
        /// Its length.
        bytes: u64,
        /// Only a receive with the same tag takes it.
        tag: u32,
    },
    /// Waits for a message and reads it. Messages of one sender and tag are read in the order in which they
    /// arrive.
    Receive {
        /// The sender.
        from: usize,
        /// The tag of the message.
        tag: u32,
    },
}
