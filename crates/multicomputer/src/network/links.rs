//! Parameters of the models with contention: links and routers.

use desim::Duration;

use super::loggp::LogGpParameters;

/// The links of a network and the routers between them.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkParameters {
    /// Bytes a second on every channel, at least the bandwidth of the message layer.
    pub bandwidth: f64,
    /// Bytes that cross a channel in one cycle, at least 1.
    pub flit_bytes: u64,
    /// Capacity of a router's buffer for each incoming virtual channel, flits, at least 1.
    pub buffer_flits: u32,
    /// Virtual channels of a link: messages that can share it, flit by flit; at least 1. On a torus,
    /// if there are two or more, half of them are reserved for messages that have passed a ring's start.
    pub virtual_channels: u32,
    /// Cycles of a router's stages.
    pub stages: RouterStages,
}

/// Cycles of a router's stages, of which only the model `flit` takes notice. Every flit crosses switch and
/// link, in what is left of the time of a hop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RouterStages {
    /// From when a head is at the front of its buffer until it asks for a virtual channel.
    pub routing: u64,
    /// From when a head gets a virtual channel until it can leave.
    pub allocation: u64,
    /// From when a flit leaves a buffer until its room can be used, at least 1.
    pub credit: u64,
}

impl Default for RouterStages {
    /// A router that routes and allocates in the cycle in which the head leaves.
    fn default() -> RouterStages {
        RouterStages { routing: 0, allocation: 0, credit: 1 }
    }
}

impl RouterStages {
    /// Cycles that only a head takes.
    pub(crate) fn of_head(&self) -> u64 {
        self.routing + self.allocation
    }
}

impl LinkParameters {
    /// Time in which a message's bytes cross a channel.
    pub(crate) fn passage(&self, bytes: u64) -> Duration {
        Duration::from_seconds_f64(bytes as f64 / self.bandwidth)
    }

    /// Time in which a flit crosses a channel, at least one tick.
    pub(crate) fn cycle(&self) -> Duration {
        self.passage(self.flit_bytes).max(Duration(1))
    }

    /// Whole cycles in a hop's time, at least one.
    pub(crate) fn cycles(&self, hop_time: Duration) -> u64 {
        (hop_time.0 / self.cycle().0).max(1)
    }

    /// Cycles from when a flit leaves a buffer until it can leave the next one, if it is not a head; at
    /// least one.
    pub(crate) fn flight(&self, hop_time: Duration) -> u64 {
        self.cycles(hop_time).saturating_sub(self.stages.of_head()).max(1)
    }

    /// Flits of a message, at least its head.
    pub(crate) fn flits(&self, bytes: u64) -> u64 {
        bytes.div_ceil(self.flit_bytes).max(1)
    }

    /// Time from the start of a message's injection until its head can enter the network. The software
    /// is slower than a link, so the head waits until the rest can follow at the rate of the links.
    ///
    /// Choice C20: at the rate of the software a message would hold its links 2.7 times as long; the
    /// real system sent packets, each of which goes at the rate of the links.
    pub(crate) fn gathering(&self, software: &LogGpParameters, bytes: u64) -> Duration {
        software.injection(bytes) - self.passage(bytes)
    }
}
