//! Quantities written as text with their units: "50 MHz", "40 ns", "72 MB/s", "10 %".
//!
//! A file never holds a bare number whose unit the reader must guess. Prefixes of bytes are
//! decimal unless they say otherwise: KB = kB = 1,000 B, MB = 1,000,000 B; KiB = 1,024 B.

use std::fmt;

/// What a quantity measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// Seconds, at least zero.
    Time,
    /// Hertz, above zero.
    Frequency,
    /// Bytes a second, above zero.
    Bandwidth,
    /// Bytes, at least zero.
    Bytes,
    /// A part of one, written in per cent, at least zero: "10 %" is 0.1.
    Fraction,
    /// Metres, at least zero.
    Length,
    /// One over metres, at least zero.
    PerLength,
    /// Cycles of a processor's clock, at least zero.
    Cycles,
}

/// How a number in some unit becomes one in the dimension's SI unit. Small units divide, since
/// 40 / 1e9 is the f64 nearest to 40 ns and 40 * 1e-9 need not be.
#[derive(Clone, Copy)]
enum Scale {
    Times(f64),
    Over(f64),
}
use Scale::{Over, Times};

type Units = &'static [(&'static str, Scale)];

impl Dimension {
    /// All of them. No unit belongs to two.
    pub const ALL: [Dimension; 8] = [
        Dimension::Time,
        Dimension::Frequency,
        Dimension::Bandwidth,
        Dimension::Bytes,
        Dimension::Fraction,
        Dimension::Length,
        Dimension::PerLength,
        Dimension::Cycles,
    ];

    /// The word for it and an example, as in "expected a frequency such as \"50 MHz\"".
    const fn word_and_example(self) -> (&'static str, &'static str) {
        match self {
            Dimension::Time => ("a time", "40 ns"),
            Dimension::Frequency => ("a frequency", "50 MHz"),
            Dimension::Bandwidth => ("a bandwidth", "72 MB/s"),
            Dimension::Bytes => ("a size", "16 MB"),
            Dimension::Fraction => ("a fraction", "10 %"),
            Dimension::Length => ("a length", "0.25 m"),
            Dimension::PerLength => ("an absorption", "0.5 /m"),
            Dimension::Cycles => ("a number of cycles", "12 cycles"),
        }
    }

    /// The word for it, with its article.
    pub const fn noun(self) -> &'static str {
        self.word_and_example().0
    }

    /// An example of a quantity of this dimension.
    pub const fn example(self) -> &'static str {
        self.word_and_example().1
    }

    /// The values that it may have, in words.
    pub const fn range(self) -> &'static str {
        if self.allows_zero() { "finite and not negative" } else { "finite and above zero" }
    }

    /// The names of the units that [`parse`] takes.
    pub fn unit_names(self) -> impl Iterator<Item = &'static str> {
        self.units().iter().map(|(name, _)| *name)
    }

    fn units(self) -> Units {
        match self {
            Dimension::Time => &[
                ("s", Times(1.0)),
                ("ms", Over(1e3)),
                ("us", Over(1e6)),
                ("µs", Over(1e6)), // the micro sign, as keyboards have it
                ("μs", Over(1e6)), // the Greek letter, as Unicode prefers it
                ("ns", Over(1e9)),
                ("ps", Over(1e12)),
            ],
            Dimension::Frequency => {
                &[("Hz", Times(1.0)), ("kHz", Times(1e3)), ("MHz", Times(1e6)), ("GHz", Times(1e9))]
            }
            Dimension::Bandwidth => &[
                ("B/s", Times(1.0)),
                ("kB/s", Times(1e3)),
                ("KB/s", Times(1e3)),
                ("MB/s", Times(1e6)),
                ("GB/s", Times(1e9)),
                ("TB/s", Times(1e12)),
                ("kbit/s", Times(125.0)),
                ("Mbit/s", Times(125_000.0)),
                ("Gbit/s", Times(125e6)),
                ("Tbit/s", Times(125e9)),
            ],
            Dimension::Bytes => &[
                ("B", Times(1.0)),
                ("kB", Times(1e3)),
                ("KB", Times(1e3)),
                ("MB", Times(1e6)),
                ("GB", Times(1e9)),
                ("TB", Times(1e12)),
                ("KiB", Times(1_024.0)),
                ("MiB", Times(1_048_576.0)),
                ("GiB", Times(1_073_741_824.0)),
                ("TiB", Times(1_099_511_627_776.0)),
            ],
            Dimension::Fraction => &[("%", Over(100.0))],
            Dimension::Length => &[("m", Times(1.0)), ("cm", Over(100.0)), ("mm", Over(1e3))],
            Dimension::PerLength => &[("/m", Times(1.0)), ("1/m", Times(1.0))],
            Dimension::Cycles => &[("cycles", Times(1.0)), ("cycle", Times(1.0))],
        }
    }

    const fn allows_zero(self) -> bool {
        !matches!(self, Dimension::Frequency | Dimension::Bandwidth)
    }
}

/// "a frequency such as \"50 MHz\"".
impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (word, example) = self.word_and_example();
        write!(f, "{word} such as {example:?}")
    }
}

/// Reads a number with a unit of the given dimension; returns it in the dimension's SI unit.
///
/// # Errors
/// What was found and what was expected, with an example.
pub fn parse(text: &str, expected: Dimension) -> Result<f64, String> {
    let (number, unit) = split(text.trim());
    let Ok(number) = number.parse::<f64>() else {
        return Err(format!("found {text:?}; expected {expected}"));
    };
    if unit.is_empty() {
        return Err(format!("found {text:?} without a unit; expected {expected}"));
    }
    let Some((_, scale)) = expected.units().iter().find(|(name, _)| *name == unit) else {
        let units = expected.unit_names().collect::<Vec<_>>().join(", ");
        let found = format!("found {text:?} with the unit {unit:?}");
        return Err(format!("{found}; expected {expected} (units: {units})"));
    };
    let value = match scale {
        Times(factor) => number * factor,
        Over(divisor) => number / divisor,
    };
    let in_range = value.is_finite() && (value > 0.0 || value == 0.0 && expected.allows_zero());
    let refuse = || format!("found {text:?}; expected {expected}, {}", expected.range());
    if in_range { Ok(value) } else { Err(refuse()) }
}

/// Splits "1.5e3 s" into "1.5e3" and "s". An `e` belongs to the number only before a digit or sign.
fn split(text: &str) -> (&str, &str) {
    let bytes = text.as_bytes();
    let is_exponent = |at: usize| {
        matches!(bytes[at], b'e' | b'E')
            && at > 0
            && bytes.get(at + 1).is_some_and(|b| b.is_ascii_digit() || matches!(b, b'+' | b'-'))
    };
    let end = (0..bytes.len())
        .find(|&at| {
            !(bytes[at].is_ascii_digit()
                || matches!(bytes[at], b'+' | b'-' | b'.')
                || is_exponent(at))
        })
        .unwrap_or(bytes.len());
    // Everything before `end` is ASCII, so that it is a boundary of characters.
    let (number, unit) = text.split_at(end);
    (number, unit.trim_start())
}

#[cfg(test)]
mod tests {
    use super::*;
    use Dimension::{Bandwidth, Bytes, Cycles, Fraction, Frequency, Length, Time};

    #[test]
    fn quantities_are_read_to_the_nearest_f64() {
        for (text, dimension, value) in [
            ("50 MHz", Frequency, 50e6),
            ("50MHz", Frequency, 50e6),
            (" 1.5e3   kHz ", Frequency, 1.5e6),
            ("40 ns", Time, 40e-9),
            ("42 us", Time, 42e-6),
            ("42 µs", Time, 42e-6),
            ("42 μs", Time, 42e-6),
            ("11.5 ns", Time, 11.5e-9),
            ("0 s", Time, 0.0),
            ("1 s", Time, 1.0),
            ("2.5E-1 ms", Time, 0.25e-3),
            ("72 MB/s", Bandwidth, 72e6),
            ("10 Mbit/s", Bandwidth, 1.25e6),
            ("100 Gbit/s", Bandwidth, 12.5e9),
            ("1.6 Tbit/s", Bandwidth, 200e9),
            ("56 kbit/s", Bandwidth, 7e3),
            ("3.35 TB/s", Bandwidth, 3.35e12),
            ("2 TB", Bytes, 2e12),
            ("1 TiB", Bytes, 1_099_511_627_776.0),
            ("4 KB", Bytes, 4_000.0),
            ("4 KiB", Bytes, 4_096.0),
            ("16 MB", Bytes, 16e6),
            ("10 %", Fraction, 0.1),
            ("7%", Fraction, 0.07),
            ("0.25 m", Length, 0.25),
            ("30 cm", Length, 0.3),
            ("12 cycles", Cycles, 12.0),
            ("1 cycle", Cycles, 1.0),
        ] {
            assert_eq!(parse(text, dimension), Ok(value), "{text}");
        }
    }

    #[test]
    fn every_example_is_one() {
        for dimension in Dimension::ALL {
            for other in Dimension::ALL {
                let read = parse(dimension.example(), other);
                assert_eq!(read.is_ok(), dimension == other, "{dimension}");
            }
        }
    }

    #[test]
    fn other_texts_are_refused_with_what_was_expected() {
        for (text, dimension, message) in [
            (
                "50",
                Frequency,
                r#"found "50" without a unit; expected a frequency such as "50 MHz""#,
            ),
            ("", Time, r#"found ""; expected a time such as "40 ns""#),
            ("soon", Time, r#"found "soon"; expected a time such as "40 ns""#),
            ("NaN s", Time, r#"found "NaN s"; expected a time such as "40 ns""#),
            ("inf s", Time, r#"found "inf s"; expected a time such as "40 ns""#),
            ("1.2.3 m", Length, r#"found "1.2.3 m"; expected a length such as "0.25 m""#),
            (
                "1 e3 m",
                Length,
                r#"found "1 e3 m" with the unit "e3 m"; expected a length such as "0.25 m" (units: m, cm, mm)"#,
            ),
            (
                "50 mHz",
                Frequency,
                r#"found "50 mHz" with the unit "mHz"; expected a frequency such as "50 MHz" (units: Hz, kHz, MHz, GHz)"#,
            ),
            (
                "10 s",
                Fraction,
                r#"found "10 s" with the unit "s"; expected a fraction such as "10 %" (units: %)"#,
            ),
            (
                "-1 s",
                Time,
                r#"found "-1 s"; expected a time such as "40 ns", finite and not negative"#,
            ),
            (
                "1e999 s",
                Time,
                r#"found "1e999 s"; expected a time such as "40 ns", finite and not negative"#,
            ),
            (
                "0 Hz",
                Frequency,
                r#"found "0 Hz"; expected a frequency such as "50 MHz", finite and above zero"#,
            ),
            (
                "0 B/s",
                Bandwidth,
                r#"found "0 B/s"; expected a bandwidth such as "72 MB/s", finite and above zero"#,
            ),
            (
                "-5 %",
                Fraction,
                r#"found "-5 %"; expected a fraction such as "10 %", finite and not negative"#,
            ),
        ] {
            let error = parse(text, dimension);
            assert_eq!(error, Err(message.to_owned()));
        }
    }

    proptest::proptest! {
        #[test]
        fn no_text_panics(text in ".*", number in proptest::num::f64::ANY) {
            let _ = parse(&text, Time);
            let _ = parse(&format!("{number:e} {text}"), Bytes);
        }
    }
}
