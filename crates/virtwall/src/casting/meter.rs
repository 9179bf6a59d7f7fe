//! What it costs a run that shots are not in memory yet.

use std::sync::atomic::{AtomicU64, Ordering};

/// Counts the shots of a problem that were not in memory when a run asked for them for the first time, and adds
/// up the host's time for which runs waited for shots: while they cast them, or others did.
pub struct ShotMeter {
    /// Reads the host's clock, seconds.
    clock: fn() -> f64,
    new: AtomicU64,
    nanoseconds: AtomicU64,
}

impl ShotMeter {
    /// A meter at zero that reads this clock, in seconds.
    pub fn new(clock: fn() -> f64) -> ShotMeter {
        ShotMeter { clock, new: AtomicU64::new(0), nanoseconds: AtomicU64::new(0) }
    }

    /// The new shots so far, and the seconds that runs waited.
    pub fn read(&self) -> (u64, f64) {
        let read = |counter: &AtomicU64| counter.load(Ordering::Relaxed);
        (read(&self.new), read(&self.nanoseconds) as f64 / 1e9)
    }

    pub(super) fn count(&self) {
        self.new.fetch_add(1, Ordering::Relaxed);
    }

    /// Adds the time that `wait` takes.
    pub(super) fn time<T>(&self, wait: impl FnOnce() -> T) -> T {
        let start = (self.clock)();
        let result = wait();
        let nanoseconds = ((self.clock)() - start) * 1e9;
        self.nanoseconds.fetch_add(nanoseconds as u64, Ordering::Relaxed);
        result
    }
}

/// Adds the time that `wait` takes, if there is a meter.
pub(super) fn timed<T>(meter: Option<&ShotMeter>, wait: impl FnOnce() -> T) -> T {
    match meter {
        Some(meter) => meter.time(wait),
        None => wait(),
    }
}
