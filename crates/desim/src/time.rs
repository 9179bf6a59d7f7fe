//! Virtual time as an integer, so that sums are exact and any two times can be compared.

use std::fmt;
use std::iter::Sum;
use std::ops::{Add, AddAssign, Mul, Sub};

/// Ticks in a second: one tick is 1 ps, and 64 bits of them last 213 days.
const TICKS_PER_SECOND: f64 = 1e12;

/// A moment of virtual time: ticks of 1 ps since the simulation's start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Time(pub u64);

/// A span of virtual time: ticks of 1 ps. Arithmetic saturates, at zero and at [`Duration::MAX`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Duration(pub u64);

impl Time {
    /// The simulation's start.
    pub const ZERO: Time = Time(0);
    /// The last representable moment, about 213 days after the start.
    pub const MAX: Time = Time(u64::MAX);

    /// Seconds since the start, rounded to the nearest f64.
    pub fn as_seconds_f64(self) -> f64 {
        self.0 as f64 / TICKS_PER_SECOND
    }
}

impl Duration {
    /// No time.
    pub const ZERO: Duration = Duration(0);
    /// The longest span, about 213 days.
    pub const MAX: Duration = Duration(u64::MAX);

    /// The tick nearest to `seconds`. Negative values give zero; too long a span and NaN give
    /// [`Duration::MAX`], which ends a simulation.
    pub fn from_seconds_f64(seconds: f64) -> Duration {
        match seconds.is_nan() {
            true => Duration::MAX,
            // A cast from f64 saturates.
            false => Duration((seconds * TICKS_PER_SECOND).round() as u64),
        }
    }

    /// The span in seconds, rounded to the nearest f64.
    pub fn as_seconds_f64(self) -> f64 {
        self.0 as f64 / TICKS_PER_SECOND
    }
}

impl Add<Duration> for Time {
    type Output = Time;
    fn add(self, span: Duration) -> Time {
        Time(self.0.saturating_add(span.0))
    }
}

impl AddAssign<Duration> for Time {
    fn add_assign(&mut self, span: Duration) {
        *self = *self + span;
    }
}

/// The span from `earlier` to `self`; zero if `earlier` is the later one.
impl Sub<Time> for Time {
    type Output = Duration;
    fn sub(self, earlier: Time) -> Duration {
        Duration(self.0.saturating_sub(earlier.0))
    }
}

impl Add for Duration {
    type Output = Duration;
    fn add(self, other: Duration) -> Duration {
        Duration(self.0.saturating_add(other.0))
    }
}

impl Sub for Duration {
    type Output = Duration;
    fn sub(self, other: Duration) -> Duration {
        Duration(self.0.saturating_sub(other.0))
    }
}

impl AddAssign for Duration {
    fn add_assign(&mut self, other: Duration) {
        *self = *self + other;
    }
}

impl Mul<u64> for Duration {
    type Output = Duration;
    fn mul(self, times: u64) -> Duration {
        Duration(self.0.saturating_mul(times))
    }
}

impl Sum for Duration {
    fn sum<I: Iterator<Item = Duration>>(spans: I) -> Duration {
        spans.fold(Duration::ZERO, Add::add)
    }
}

/// The last moment stands for all that are later.
impl fmt::Display for Time {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Time::MAX => f.pad("a time later than virtual time lasts"),
            Time(ticks) => f.pad(&in_largest_unit(ticks)),
        }
    }
}

/// The longest span stands for all that are longer.
impl fmt::Display for Duration {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Duration::MAX => f.pad("longer than virtual time lasts"),
            Duration(ticks) => f.pad(&in_largest_unit(ticks)),
        }
    }
}

/// Exact decimal text in the largest unit of which the ticks hold at least one: "147.58 s",
/// "42 µs". Exact, so that a golden trace shows every tick.
fn in_largest_unit(ticks: u64) -> String {
    const UNITS: [(usize, &str); 4] = [(12, "s"), (9, "ms"), (6, "µs"), (3, "ns")];
    if ticks == 0 {
        return "0 s".to_owned();
    }
    for (decimals, unit) in UNITS {
        let one = 10_u64.pow(decimals as u32);
        if ticks >= one {
            let fraction = format!("{:0decimals$}", ticks % one);
            let text = format!("{}.{fraction}", ticks / one);
            return format!("{} {unit}", text.trim_end_matches('0').trim_end_matches('.'));
        }
    }
    format!("{ticks} ps")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_round_to_the_nearest_tick_and_saturate() {
        let ps = |seconds| Duration::from_seconds_f64(seconds).0;
        assert_eq!(ps(147.58), 147_580_000_000_000);
        assert_eq!(ps(1.4e-12), 1);
        assert_eq!(ps(1.6e-12), 2);
        assert_eq!(ps(-1.0), 0);
        assert_eq!(ps(f64::NAN), u64::MAX);
        assert_eq!(ps(f64::NEG_INFINITY), 0);
        assert_eq!(ps(f64::INFINITY), u64::MAX);
        assert_eq!(ps(1e30), u64::MAX);
        assert_eq!(Duration::from_seconds_f64(0.25).as_seconds_f64(), 0.25);
    }

    #[test]
    fn arithmetic_saturates() {
        let one = Duration(1);
        assert_eq!(Duration::ZERO - one, Duration::ZERO);
        assert_eq!(Duration::MAX + one, Duration::MAX);
        assert_eq!(Duration::MAX * 2, Duration::MAX);
        assert_eq!(Time::MAX + one, Time::MAX);
        assert_eq!(Time::ZERO - Time(5), Duration::ZERO);
        assert_eq!(Time(7) - Time(5), Duration(2));
        assert_eq!([one, one * 3].into_iter().sum::<Duration>(), Duration(4));
    }

    #[test]
    fn text_is_exact() {
        for (ticks, text) in [
            (0, "0 s"),
            (1, "1 ps"),
            (999, "999 ps"),
            (1_000, "1 ns"),
            (23_040, "23.04 ns"),
            (42_000_000, "42 µs"),
            (105_000_001, "105.000001 µs"),
            (2_400_000_000, "2.4 ms"),
            (10_000_000_000_000, "10 s"),
            (147_580_000_000_000, "147.58 s"),
            (u64::MAX - 1, "18446744.073709551614 s"),
        ] {
            assert_eq!(Time(ticks).to_string(), text);
            assert_eq!(Duration(ticks).to_string(), text);
        }
        assert_eq!(format!("[{:>10}]", Time(1_000)), "[      1 ns]");
        assert_eq!(Time::MAX.to_string(), "a time later than virtual time lasts");
        assert_eq!(Duration::MAX.to_string(), "longer than virtual time lasts");
    }
}
