//! What the message layer of a node adds to the overheads of a message: packets, a coprocessor, the
//! copy of a message that nobody waited for, and buffers that can be full.
//!
//! Each is a part of the machine file by itself, and absent unless it stands there:
//!
//! ```text
//! sender     |-- room in the receiver's buffers? --|-- a packet --|-- a packet --|-- o --|
//! receiver                                         ... network ... |-- o --|-- copy --|
//! ```
//!
//! All of it, but for the copy, moves to the coprocessor where a node has one; the processor then
//! only hands the message over, or takes it from there.

use desim::Duration;
use schemars::JsonSchema;
use serde::Deserialize;

use crate::file::MachineFault;
use crate::file::{Bandwidth, Bytes, Quantity, Sourced, Time, whole_bytes};

/// What a node's message layer does besides LogGP's overheads; the default is nothing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MessageLayer {
    /// The packets that a message is cut into.
    pub packets: Option<Packets>,
    /// For a message that the coprocessor sends or receives, the time of the processor, which hands
    /// it over or takes it; none without a coprocessor.
    pub handover: Option<Duration>,
    /// Bytes a second of the copy out of system buffers that a message needs for which no receive
    /// was posted: one that arrives while its receiver does not wait. Always the processor's.
    pub copy_bandwidth: Option<f64>,
    /// Bytes of the buffers for messages that arrive at a node and were not read.
    pub buffer_bytes: Option<u64>,
}

/// How messages are cut into packets.
#[derive(Clone, Debug, PartialEq)]
pub struct Packets {
    /// Bytes of one, at least 1.
    pub bytes: u64,
    /// Time that one takes before it is sent, be it full or not.
    pub time: Duration,
}

impl MessageLayer {
    /// Time to make packets of a message; an empty one needs a packet, too.
    pub fn packing(&self, bytes: u64) -> Duration {
        let packing = |packets: &Packets| packets.time * bytes.div_ceil(packets.bytes).max(1);
        self.packets.as_ref().map_or(Duration::ZERO, packing)
    }

    /// Time to copy so many bytes of messages out of the buffers.
    pub fn copying(&self, bytes: u64) -> Duration {
        let copying = |bandwidth| Duration::from_seconds_f64(bytes as f64 / bandwidth);
        self.copy_bandwidth.map_or(Duration::ZERO, copying)
    }
}

/// The message layer, as a machine file has it.
#[derive(Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields, expecting = "an object that describes a message layer")]
pub(crate) struct MessageLayerFile {
    /// A message is cut into packets, each of which takes its sender time.
    packets: Option<PacketsFile>,
    /// A second processor sends and receives, while the first one computes.
    coprocessor: Option<CoprocessorFile>,
    /// Bytes a second at which a message is copied that arrives while its receiver does not wait for
    /// one.
    copy_bandwidth: Option<Sourced<Quantity<Bandwidth>>>,
    /// Room at a node for messages that were sent to it and not read; a sender waits until there is
    /// enough. A message that is longer has them to itself.
    buffers: Option<Sourced<Quantity<Bytes>>>,
}

/// How messages are cut into packets.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object that describes packets")]
struct PacketsFile {
    /// A whole number of bytes.
    size: Sourced<Quantity<Bytes>>,
    /// Time for a packet, full or not, besides that of its bytes on the network.
    time: Sourced<Quantity<Time>>,
}

/// A processor for messages.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object that describes a message coprocessor")]
struct CoprocessorFile {
    /// Time of the first processor for a message that it hands to the coprocessor, or takes from it.
    /// The overheads of the network's parameters are the coprocessor's.
    handover: Sourced<Quantity<Time>>,
}

impl MessageLayerFile {
    /// The message layer, if its sizes are whole numbers of bytes.
    pub(crate) fn check(&self) -> Result<MessageLayer, MachineFault> {
        let packets = self.packets.as_ref().map(|packets| {
            let bytes = whole_bytes("message_layer.packets.size", &packets.size)?;
            Ok(Packets { bytes, time: packets.time.value.duration() })
        });
        let buffers = self.buffers.as_ref();
        Ok(MessageLayer {
            packets: packets.transpose()?,
            handover: self.coprocessor.as_ref().map(|c| c.handover.value.duration()),
            copy_bandwidth: self.copy_bandwidth.as_ref().map(|copy| copy.value.si),
            buffer_bytes: buffers
                .map(|bytes| whole_bytes("message_layer.buffers", bytes))
                .transpose()?,
        })
    }
}
