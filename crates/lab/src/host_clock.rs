//! The host's clock: how long we took, for people to know. No result depends on it.

use std::time::Instant;

/// A moment of host time.
pub struct HostClock(Instant);

impl HostClock {
    /// Starts counting.
    #[expect(clippy::disallowed_methods, reason = "goes to host-times.json alone")]
    pub fn start() -> HostClock {
        HostClock(Instant::now())
    }

    /// Host seconds since the start.
    pub fn seconds(&self) -> f64 {
        self.0.elapsed().as_secs_f64()
    }
}
