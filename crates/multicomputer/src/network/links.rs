//! What the networks with contention need to know of a machine.

use desim::Duration;

use super::loggp::LogGpParameters;

/// The links of a network and the routers between them.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkParameters {
    /// Bytes a second on every channel, at least as many as the software feeds to a node's port.
    pub bandwidth: f64,
    /// Bytes that cross a channel in one cycle, at least 1.
    pub flit_bytes: u64,
    /// Flits that a router keeps of what comes in by a virtual channel, at least 1.
    pub buffer_flits: u32,
    /// Messages that can have a link at a time, taking turns flit by flit, at least 1. On a torus
    /// from two on, those that have passed a ring's start have half of them to themselves.
    pub virtual_channels: u32,
}

impl LinkParameters {
    /// Time in which a message's bytes pass a point of the network.
    pub(crate) fn passage(&self, bytes: u64) -> Duration {
        Duration::from_seconds_f64(bytes as f64 / self.bandwidth)
    }

    /// Time in which a flit crosses a channel, at least a tick.
    pub(crate) fn cycle(&self) -> Duration {
        self.passage(self.flit_bytes).max(Duration::from_ps(1))
    }

    /// Whole cycles in a hop's time, at least one.
    pub(crate) fn cycles(&self, hop_time: Duration) -> u64 {
        (hop_time.as_ps() / self.cycle().as_ps()).max(1)
    }

    /// Flits of a message: it has a head even when it is empty.
    pub(crate) fn flits(&self, bytes: u64) -> u64 {
        bytes.div_ceil(self.flit_bytes).max(1)
    }

    /// Time that the software takes for a message before the network can take it in without a pause:
    /// the software is slower than a link, so a message enters when its rest can follow in time.
    ///
    /// Choice C20: a worm that crawled at the software's pace would hold its links 2.7 times as long;
    /// the real system sent packets, each of which goes at the links' pace.
    pub(crate) fn gathering(&self, software: &LogGpParameters, bytes: u64) -> Duration {
        software.injection(bytes) - self.passage(bytes)
    }
}
