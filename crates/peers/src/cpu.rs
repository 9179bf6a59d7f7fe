//! Processor time, and statistics of measurements.

use std::hint::black_box;

use rustix::time::{ClockId, clock_gettime};

/// Processor seconds of this thread. Other work on the host disturbs them less than wall-clock time.
fn seconds() -> f64 {
    let now = clock_gettime(ClockId::ThreadCPUTime);
    now.tv_sec as f64 + 1e-9 * now.tv_nsec as f64
}

/// The result of an action, and the processor seconds that it takes.
pub fn timed<T>(action: impl FnOnce() -> T) -> (T, f64) {
    let start = seconds();
    let result = action();
    (result, seconds() - start)
}

/// Clock rate in hertz, measured with a chain of dependent shifts and exclusive ors that take one cycle each
/// (Marsaglia's xorshift64).
pub fn clock() -> f64 {
    const STEPS: u64 = 100_000_000;
    let (_, seconds) = timed(|| {
        let step = |mut x: u64, _| {
            x ^= x << 13;
            x ^= x >> 7;
            x ^ x << 17
        };
        black_box((0..STEPS).fold(black_box(1996), step))
    });
    6.0 * STEPS as f64 / seconds
}

/// Least, median and greatest of repeated measurements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    pub least: f64,
    /// The middle one, or the mean of the two in the middle.
    pub median: f64,
    pub greatest: f64,
}

impl Spread {
    /// The spread of at least one measurement.
    pub fn of(mut figures: Vec<f64>) -> Spread {
        figures.sort_unstable_by(f64::total_cmp);
        let n = figures.len();
        let median = f64::midpoint(figures[(n - 1) / 2], figures[n / 2]);
        Spread { least: figures[0], median, greatest: figures[n - 1] }
    }
}

pub fn rounded(figure: f64) -> f64 {
    (figure * 1e3).round() / 1e3
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_in_the_middle() {
        let spread = Spread::of(vec![4.0, 1.0, 9.0, 2.0]);
        assert_eq!(spread, Spread { least: 1.0, median: 3.0, greatest: 9.0 });
        assert_eq!(Spread::of(vec![4.0, 1.0, 9.0]).median, 4.0);
    }
}
