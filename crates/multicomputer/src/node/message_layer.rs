//! The message layer of a node: packets, a coprocessor, copies of unexpected messages, and finite buffers.
//!
//! It adds to the overheads of the network model. Each part is optional in the machine file:
//!
//! ```text
//! sender     |-- room in the receiver's buffers? --|-- a packet --|-- a packet --|-- o --|
//! receiver                                         ... network ... |-- o --|-- copy --|
//! ```
//!
//! A coprocessor does all of this but the copy; the processor then only hands a message over, or takes
//! it from there.

use config::{Bandwidth, Bytes, Fault, Quantity, Time};
use desim::Duration;
use schemars::JsonSchema;
use serde::Deserialize;

use crate::sourced::{Sourced, whole_bytes};

/// A node's message layer, besides the overheads of the network model. By default it costs nothing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MessageLayer {
    /// The packets that a message is cut into.
    pub packets: Option<Packets>,
    /// The processor's time to hand a message over to the coprocessor, or to take it from there; none
    /// without a coprocessor.
    pub handover: Option<Duration>,
    /// Bytes a second at which the processor copies a message out of system buffers. Only a message
    /// that arrives with no receive posted, while its receiver does not wait, is copied.
    pub copy_bandwidth: Option<f64>,
    /// Bytes of a node's buffers for messages that were sent to it and not read; none if unlimited.
    pub buffer_bytes: Option<u64>,
}

/// How messages are cut into packets.
#[derive(Clone, Debug, PartialEq)]
pub struct Packets {
    /// Bytes of one, at least 1.
    pub bytes: u64,
    /// Time to make one, full or not.
    pub time: Duration,
}

impl MessageLayer {
    /// Time to make the packets of a message; an empty message is one packet.
    pub fn packing(&self, bytes: u64) -> Duration {
        let packing = |packets: &Packets| packets.time * bytes.div_ceil(packets.bytes).max(1);
        self.packets.as_ref().map_or(Duration::ZERO, packing)
    }

    /// Time to copy messages of `bytes` out of the buffers.
    pub fn copying(&self, bytes: u64) -> Duration {
        let copying = |bandwidth| Duration::from_seconds_f64(bytes as f64 / bandwidth);
        self.copy_bandwidth.map_or(Duration::ZERO, copying)
    }
}

/// The message layer in a machine file.
#[derive(Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields, expecting = "an object that describes a message layer")]
pub(crate) struct MessageLayerFile {
    /// Messages are cut into packets, each of which takes the sender time.
    packets: Option<PacketsFile>,
    /// A second processor sends and receives messages while the first one computes.
    coprocessor: Option<CoprocessorFile>,
    /// Bytes a second at which a message is copied if it arrives while its receiver does not wait for
    /// one.
    copy_bandwidth: Option<Sourced<Quantity<Bandwidth>>>,
    /// Room at a node for messages that were sent to it and not read. A sender waits until there is
    /// enough. A longer message waits until the buffers are empty.
    buffers: Option<Sourced<Quantity<Bytes>>>,
}

/// How messages are cut into packets.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object that describes packets")]
struct PacketsFile {
    /// Bytes of one, a whole number.
    size: Sourced<Quantity<Bytes>>,
    /// Time to make a packet, full or not, in addition to its time on the network.
    time: Sourced<Quantity<Time>>,
}

/// A processor for messages.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object that describes a message coprocessor")]
struct CoprocessorFile {
    /// Time of the first processor to hand a message to the coprocessor, or to take one from it. The
    /// coprocessor then has the overheads of the network's parameters.
    handover: Sourced<Quantity<Time>>,
}

impl MessageLayerFile {
    /// Checks that sizes are whole numbers of bytes.
    pub(crate) fn check(&self) -> Result<MessageLayer, Fault> {
        let packets = self.packets.as_ref().map(|packets| {
            let bytes = whole_bytes("message_layer.packets.size", &packets.size)?;
            Ok(Packets { bytes, time: packets.time.duration() })
        });
        let buffers = self.buffers.as_ref();
        Ok(MessageLayer {
            packets: packets.transpose()?,
            handover: self.coprocessor.as_ref().map(|c| c.handover.duration()),
            copy_bandwidth: self.copy_bandwidth.as_ref().map(|copy| copy.si()),
            buffer_bytes: buffers
                .map(|bytes| whole_bytes("message_layer.buffers", bytes))
                .transpose()?,
        })
    }
}
