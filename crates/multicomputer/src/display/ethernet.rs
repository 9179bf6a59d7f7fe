//! An Ethernet: a medium that carries one frame at a time.

use config::{Bandwidth, Bytes, Fault, Quantity};
use desim::Duration;
use schemars::JsonSchema;
use serde::Deserialize;

use crate::sourced::{Sourced, whole_bytes};

/// An Ethernet without other senders, so without collisions. Frames are not padded to the minimum length.
#[derive(Clone, Debug, PartialEq)]
pub struct Ethernet {
    /// Bytes a second on the wire.
    pub bandwidth: f64,
    /// The most bytes of a message that a frame carries, at least 1.
    pub payload: u64,
    /// Other bytes on the wire for each frame: preamble, headers, checksum, gap.
    pub overhead: u64,
}

impl Ethernet {
    /// Frames of a message; an empty message is one frame.
    pub fn frames(&self, bytes: u64) -> u64 {
        bytes.div_ceil(self.payload).max(1)
    }

    /// How long a message occupies the medium.
    pub fn time(&self, bytes: u64) -> Duration {
        let all = bytes as f64 + self.frames(bytes) as f64 * self.overhead as f64;
        Duration::from_seconds_f64(all / self.bandwidth)
    }
}

/// The medium in a machine file.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object that describes an Ethernet")]
pub(crate) struct EthernetFile {
    /// Bytes a second on the wire.
    bandwidth: Sourced<Quantity<Bandwidth>>,
    /// The most bytes of a message that a frame carries.
    payload: Sourced<Quantity<Bytes>>,
    /// Other bytes on the wire for each frame: preamble, headers, checksum, gap.
    overhead: Sourced<Quantity<Bytes>>,
}

impl EthernetFile {
    pub(crate) fn check(&self) -> Result<Ethernet, Fault> {
        Ok(Ethernet {
            bandwidth: self.bandwidth.si(),
            payload: whole_bytes("display.ethernet.payload", &self.payload)?,
            overhead: self.overhead.si().round() as u64,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 10 Mbit/s, TCP over Ethernet: 1,460 bytes in 1,538.
    #[test]
    fn the_time_of_a_message_is_that_of_its_frames() {
        let ethernet = Ethernet { bandwidth: 1.25e6, payload: 1_460, overhead: 78 };
        let microseconds = |bytes| ethernet.time(bytes).as_seconds_f64() * 1e6;
        for (bytes, frames, time) in
            [(0, 1, 62.4), (1, 1, 63.2), (1_460, 1, 1_230.4), (1_461, 2, 1_293.6)]
        {
            assert_eq!(ethernet.frames(bytes), frames);
            assert!((microseconds(bytes) - time).abs() < 1e-3, "{bytes}");
        }
        // A megabyte of full frames: 94.9 % of the wire's rate, the known limit of TCP.
        let rate = 1.46e6 / ethernet.time(1_460_000).as_seconds_f64();
        assert!((rate / 1.25e6 - 0.9493).abs() < 1e-4);
    }
}
