//! A message, as the network sees it.

use super::topology::Place;

/// A message, as the network sees it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Message {
    /// The sender's number for it, unique among the messages in flight.
    pub id: u64,
    /// The sender's place.
    pub from: Place,
    /// The receiver's place.
    pub to: Place,
    /// Its length in bytes.
    pub bytes: u64,
}
