//! What is sent over a network.

use super::topology::Place;

/// A message, as the network sees it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Message {
    /// The sender's name for it, unlike that of any other message under way.
    pub id: u64,
    /// Where it is sent.
    pub from: Place,
    /// Where it goes.
    pub to: Place,
    /// Its length.
    pub bytes: u64,
}
