//! Clocks of the host. No result depends on them.

use std::sync::LazyLock;
use std::time::Instant;

use cpu_time::ThreadTime;
use serde::{Deserialize, Serialize};

/// A stopwatch for elapsed time and for the CPU time of one thread.
pub struct HostClock {
    instant: Instant,
    thread: ThreadTime,
}

impl HostClock {
    /// Starts the stopwatch.
    #[expect(clippy::disallowed_methods, reason = "goes to host-times.json alone")]
    pub fn start() -> HostClock {
        HostClock { instant: Instant::now(), thread: ThreadTime::now() }
    }

    /// Host seconds since the start.
    pub fn seconds(&self) -> f64 {
        self.instant.elapsed().as_secs_f64()
    }

    /// CPU seconds since the start, of the thread that started it and must call this. Time in which other
    /// threads had the processor does not count.
    pub fn cpu_seconds(&self) -> f64 {
        self.thread.elapsed().as_secs_f64()
    }
}

/// Host seconds since the first call.
#[expect(clippy::disallowed_methods, reason = "for estimates of what is left")]
pub fn host_seconds() -> f64 {
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    START.elapsed().as_secs_f64()
}

/// Something that is due at intervals of host time.
pub struct Interval {
    clock: HostClock,
    every: f64,
    due: f64,
}

impl Interval {
    /// An interval of `every` seconds; due at once for the first time.
    pub fn new(every: f64) -> Interval {
        Interval { clock: HostClock::start(), every, due: 0.0 }
    }

    /// Whether it is due. If so, it is due again one interval from now.
    pub fn is_due(&mut self) -> bool {
        let now = self.clock.seconds();
        let due = now >= self.due;
        if due {
            self.due = now + self.every;
        }
        due
    }
}

#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct HostTimes {
    /// CPU seconds of the thread that carried out the run, without the help of other threads.
    pub cpu_s: f64,
    /// CPU seconds to prepare its scene: reading, cleaning, cutting, meshing. Runs of the same scene share
    /// this work.
    pub set_up_s: f64,
    pub clock_s: f64,
}
