//! What lies between the service node and a display: the processor that makes frames, the Ethernet, and
//! the display that takes them.

use desim::Duration;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::ethernet::{Ethernet, EthernetFile};
use crate::file::MachineFault;
use crate::file::{Bandwidth, Bytes, Quantity, Sourced, Time, whole_bytes};

/// The way of an update from the service node to a display:
///
/// ```text
/// compute node   |-- o --|
/// service node           ... service_buffers ... |-- o --|-- frames --|
/// Ethernet                                        ... window ...      |-- wire --|
/// display                                                             ...        |-- update --|
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Display {
    /// Time of the service node's processor for a frame.
    pub frame_time: Duration,
    /// Bytes a second at which that processor puts updates into frames.
    pub copy_bandwidth: f64,
    /// Bytes of updates that the service node holds before it sends them on.
    pub service_buffers: u64,
    /// What happens when these are full.
    pub when_full: WhenFull,
    /// What carries the frames.
    pub ethernet: Ethernet,
    /// Bytes of updates that may be sent and not taken by the display.
    pub window: u64,
    /// Time in which the display takes an update in.
    pub update_time: Duration,
}

/// What happens to updates for which the service node has no room.
///
/// Choice C31: Figure 6 of RR-3008 receives and sends one after the other, and says no more.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WhenFull {
    /// They wait where they are: compute nodes wait until there is room.
    BackPressure,
    /// The ones that have waited longest are dropped for them.
    DropOldest,
    /// They are dropped.
    DropNewest,
}

impl Display {
    /// Time of the service node's processor to send an update on.
    pub fn forwarding(&self, bytes: u64) -> Duration {
        self.frame_time * self.ethernet.frames(bytes)
            + Duration::from_seconds_f64(bytes as f64 / self.copy_bandwidth)
    }

    /// Updates of so many bytes that can be shown a second, whatever limits them.
    pub fn rate(&self, bytes: u64) -> f64 {
        let slowest = self.forwarding(bytes).max(self.ethernet.time(bytes)).max(self.update_time);
        1.0 / slowest.as_seconds_f64()
    }

    /// Room for mail at the service node, if senders wait for it.
    pub(crate) fn room_for_mail(&self) -> Option<u64> {
        (self.when_full == WhenFull::BackPressure).then_some(self.service_buffers)
    }
}

/// A display, as a machine file has it.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object that describes a display")]
pub(crate) struct DisplayFile {
    /// The processor of the service node, as far as it sends updates on.
    service: ServiceFile,
    /// Room at the service node for updates that were not sent on. One that is longer has it to itself.
    /// With "back_pressure" it is for all messages, in place of the message layer's buffers.
    service_buffers: Sourced<Quantity<Bytes>>,
    /// What happens when that is full.
    when_full: WhenFull,
    /// What carries the frames.
    ethernet: EthernetFile,
    /// Updates that may be sent and not taken by the display: what the sockets of both sides hold.
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
    /// Bytes a second at which it puts updates into frames.
    copy_bandwidth: Sourced<Quantity<Bandwidth>>,
}

/// The computer that shows what comes.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object that describes who takes the updates")]
struct ConsumerFile {
    /// Time in which it takes an update in.
    update_time: Sourced<Quantity<Time>>,
}

impl DisplayFile {
    pub(crate) fn check(&self) -> Result<Display, MachineFault> {
        Ok(Display {
            frame_time: self.service.frame_time.value.duration(),
            copy_bandwidth: self.service.copy_bandwidth.value.si,
            service_buffers: whole_bytes("display.service_buffers", &self.service_buffers)?,
            when_full: self.when_full,
            ethernet: self.ethernet.check()?,
            window: whole_bytes("display.window", &self.window)?,
            update_time: self.consumer.update_time.value.duration(),
        })
    }
}
