//! Figures of the message layer, where the machine models one.

use multicomputer::{LayerAccount, Machine, MessageLayer};
use serde::{Deserialize, Serialize};

/// What the message layer did on all compute nodes, in addition to overheads.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MessageLayerFigures {
    /// Seconds given to making packets.
    pub packing_s: f64,
    /// Seconds given to copying messages that arrived with no receive posted.
    pub copying_s: f64,
    /// Seconds that processors waited for room in buffers.
    pub waiting_for_room_s: f64,
    /// Seconds in which message coprocessors were busy.
    pub coprocessor_s: f64,
    /// Messages that arrived with no receive posted.
    pub unposted_messages: u64,
    /// Messages that had to wait for room in buffers.
    pub held_messages: u64,
    /// Greatest number of bytes in use at a time in one node's buffers.
    pub buffer_bytes_most: u64,
}

/// Whether results have figures of the message layer: whether the machine models one.
pub fn tells(machine: &Machine) -> bool {
    machine.message_layer != MessageLayer::default()
}

impl MessageLayerFigures {
    /// The figures of an account.
    pub fn of(account: &LayerAccount) -> MessageLayerFigures {
        MessageLayerFigures {
            packing_s: account.packing.as_seconds_f64(),
            copying_s: account.copying.as_seconds_f64(),
            waiting_for_room_s: account.waiting_for_room.as_seconds_f64(),
            coprocessor_s: account.coprocessor.as_seconds_f64(),
            unposted_messages: account.unposted_messages,
            held_messages: account.held_messages,
            buffer_bytes_most: account.buffer_bytes_most,
        }
    }
}
