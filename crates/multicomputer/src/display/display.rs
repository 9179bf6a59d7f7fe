//! From the service node to a display: the processor that makes frames, the Ethernet that carries them, and
//! the display that shows them.

use config::{Bandwidth, Bytes, Fault, Quantity, Time};
use desim::Duration;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::ethernet::{Ethernet, EthernetFile};
use crate::sourced::{Sourced, whole_bytes};

/// The path of an update from a compute node to a display:
///
/// ```text
/// compute node   |-- o --|
/// service node           ... service_buffers ... |-- o --|-- frames --|
/// Ethernet                                        ... window ...      |-- wire --|
/// display                                                             ...        |-- update --|
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Display {
    /// The service node's time for a frame.
    pub frame_time: Duration,
    /// Bytes a second at which the service node copies updates into frames.
    pub copy_bandwidth: f64,
    /// Bytes of updates that the service node can queue.
    pub service_buffers: u64,
    /// What happens when this queue is full.
    pub when_full: WhenFull,
    /// The medium of the frames.
    pub ethernet: Ethernet,
    /// Bytes of updates that may be sent before the display has taken them.
    pub window: u64,
    /// The display's time for an update.
    pub update_time: Duration,
}

/// What happens to updates for which the service node has no room.
///
/// Choice C31: Figure 6 of RR-3008 receives and sends in turn, and does not say.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WhenFull {
    /// Compute nodes wait until there is room.
    BackPressure,
    /// The oldest queued updates are dropped for them.
    DropOldest,
    /// They are dropped.
    DropNewest,
}

impl Display {
    /// The service node's time to send an update.
    pub fn forwarding(&self, bytes: u64) -> Duration {
        self.frame_time * self.ethernet.frames(bytes)
            + Duration::from_seconds_f64(bytes as f64 / self.copy_bandwidth)
    }

    /// Updates of `bytes` that can be shown a second: the slowest of service node, Ethernet and
    /// display limits them.
    pub fn rate(&self, bytes: u64) -> f64 {
        let slowest = self.forwarding(bytes).max(self.ethernet.time(bytes)).max(self.update_time);
        1.0 / slowest.as_seconds_f64()
    }

    /// Bytes of the service node's message buffers, if senders wait for room in them.
    pub(crate) fn room_for_mail(&self) -> Option<u64> {
        (self.when_full == WhenFull::BackPressure).then_some(self.service_buffers)
    }
}

/// A display in a machine file.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object that describes a display")]
pub(crate) struct DisplayFile {
    /// The service node's processor, when it sends updates.
    service: ServiceFile,
    /// Room at the service node for updates that were not sent. A longer update waits until it is
    /// empty. With "back_pressure" it holds all messages and replaces the message layer's buffers.
    service_buffers: Sourced<Quantity<Bytes>>,
    /// What happens when this room is full.
    when_full: WhenFull,
    /// The medium of the frames.
    ethernet: EthernetFile,
    /// Bytes of updates that may be sent before the display has taken them: the buffers of both sockets.
    window: Sourced<Quantity<Bytes>>,
    /// The display itself.
    consumer: ConsumerFile,
}

/// What the service node's processor does for the display.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object that describes a service node")]
struct ServiceFile {
    /// Time for a frame.
    frame_time: Sourced<Quantity<Time>>,
    /// Bytes a second at which it copies updates into frames.
    copy_bandwidth: Sourced<Quantity<Bandwidth>>,
}

/// The computer that shows updates.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object that describes who takes the updates")]
struct ConsumerFile {
    /// Time for an update.
    update_time: Sourced<Quantity<Time>>,
}

impl DisplayFile {
    pub(crate) fn check(&self) -> Result<Display, Fault> {
        Ok(Display {
            frame_time: self.service.frame_time.duration(),
            copy_bandwidth: self.service.copy_bandwidth.si(),
            service_buffers: whole_bytes("display.service_buffers", &self.service_buffers)?,
            when_full: self.when_full,
            ethernet: self.ethernet.check()?,
            window: whole_bytes("display.window", &self.window)?,
            update_time: self.consumer.update_time.duration(),
        })
    }
}
