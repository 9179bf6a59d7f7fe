//! LogGP: overhead, latency, gap and gap per byte, with the hops of a mesh and no contention.
//!
//! Alexandrov, Ionescu, Schauser, Scheiman: LogGP, SPAA 1995. A message of n bytes takes
//!
//! ```text
//! sender    |-- o --|
//! port              |-- n G --|-- g --|      (not before it is free of the last message)
//! network                     |-- L + hops h --|
//! receiver                                     |-- o --|
//! ```
//!
//! The port works on its own, as the message processor of a Paragon's node does: a sender goes on
//! after its overhead even when the port is still busy with its earlier messages.

use desim::{Duration, Time};

use super::delivery::{Delivery, Network};
use crate::mesh::{Mesh, Place};

/// Parameters of the model.
#[derive(Clone, Debug, PartialEq)]
pub struct LogGpParameters {
    /// o at the sender.
    pub send_overhead: Duration,
    /// L, without hops.
    pub latency: Duration,
    /// h: from router to router.
    pub hop_time: Duration,
    /// o at the receiver.
    pub receive_overhead: Duration,
    /// g: from the end of one injection to the start of the next.
    pub gap: Duration,
    /// 1/G: bytes a second.
    pub bandwidth: f64,
}

/// A network after LogGP.
pub struct LogGp {
    parameters: LogGpParameters,
    mesh: Mesh,
    /// When each place's port can begin to inject again.
    port_free: Vec<Time>,
}

impl LogGp {
    /// A network with nothing under way.
    pub fn new(parameters: LogGpParameters, mesh: &Mesh) -> LogGp {
        let port_free = vec![Time::ZERO; mesh.graph().node_count()];
        LogGp { parameters, mesh: mesh.clone(), port_free }
    }
}

impl Network for LogGp {
    fn deliver(&mut self, now: Time, from: Place, to: Place, bytes: u64) -> Delivery {
        let LogGpParameters { send_overhead, latency, hop_time, gap, bandwidth, .. } =
            self.parameters;
        let sender_free = now + send_overhead;
        let port_free = &mut self.port_free[from.index()];
        let injected =
            sender_free.max(*port_free) + Duration::from_seconds_f64(bytes as f64 / bandwidth);
        *port_free = injected + gap;
        let hops = u64::from(self.mesh.hops(from, to));
        Delivery { sender_free, arrives: injected + latency + hop_time * hops }
    }

    fn receive_overhead(&self) -> Duration {
        self.parameters.receive_overhead
    }
}
