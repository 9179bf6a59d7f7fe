//! The host's clock. No result depends on it.

use std::time::Instant;

use cpu_time::ThreadTime;
use serde::{Deserialize, Serialize};

/// A moment of host time.
pub struct HostClock {
    instant: Instant,
    thread: ThreadTime,
}

impl HostClock {
    /// Starts counting.
    #[expect(clippy::disallowed_methods, reason = "goes to host-times.json alone")]
    pub fn start() -> HostClock {
        HostClock { instant: Instant::now(), thread: ThreadTime::now() }
    }

    /// Host seconds since the start.
    pub fn seconds(&self) -> f64 {
        self.instant.elapsed().as_secs_f64()
    }

    /// CPU seconds of this thread, which started the clock, since then: others that share its
    /// processor do not lengthen them.
    pub fn cpu_seconds(&self) -> f64 {
        self.thread.elapsed().as_secs_f64()
    }
}

/// Something that is due at intervals of host time.
pub struct Interval {
    clock: HostClock,
    every: f64,
    due: f64,
}

impl Interval {
    /// Of this number of seconds; due at once.
    pub fn new(every: f64) -> Interval {
        Interval { clock: HostClock::start(), every, due: 0.0 }
    }

    /// Whether it is due; if so, next time is an interval from now.
    pub fn is_due(&mut self) -> bool {
        let now = self.clock.seconds();
        let due = now >= self.due;
        if due {
            self.due = now + self.every;
        }
        due
    }
}

/// Host times of one run.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct HostTimes {
    /// CPU seconds of the thread that did it; what other threads did for it is not among them.
    pub cpu_s: f64,
    /// CPU seconds of making its scene ready: reading, cleaning, cutting, meshing. Runs share it.
    pub set_up_s: f64,
    /// Seconds on the clock.
    pub clock_s: f64,
}
