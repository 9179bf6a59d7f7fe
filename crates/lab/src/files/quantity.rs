//! Numbers with units and small grids, as text in our files.

use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserializer, Error};
use serde::{Deserialize, Serialize, Serializer};
use serde_json::Value;

use multicomputer::quantity::{self, Dimension};

/// What a quantity measures, and which values it may take.
pub trait Kind {
    /// Its name in messages, with the article.
    const NAME: &'static str;
    /// Its dimension.
    const DIMENSION: Dimension;
    /// An example, for messages and schemas.
    const EXAMPLE: &'static str;
    /// The values allowed, in words.
    const RANGE: &'static str;
    /// Whether a value, in the base unit, is allowed.
    fn allows(value: f64) -> bool;
}

/// A length of more than 0 m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LengthKind;

impl Kind for LengthKind {
    const NAME: &'static str = "a length";
    const DIMENSION: Dimension = Dimension::Length;
    const EXAMPLE: &'static str = "0.30 m";
    const RANGE: &'static str = "more than 0";
    fn allows(value: f64) -> bool {
        value > 0.0
    }
}

/// A share from 0 to 100 %.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FractionKind;

impl Kind for FractionKind {
    const NAME: &'static str = "a fraction";
    const DIMENSION: Dimension = Dimension::Fraction;
    const EXAMPLE: &'static str = "10 %";
    const RANGE: &'static str = "from 0 % to 100 %";
    fn allows(value: f64) -> bool {
        (0.0..=1.0).contains(&value)
    }
}

/// A span of virtual time of more than 0 s, up to a day: virtual time is counted in picoseconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PeriodKind;

impl Kind for PeriodKind {
    const NAME: &'static str = "a time";
    const DIMENSION: Dimension = Dimension::Time;
    const EXAMPLE: &'static str = "1 s";
    const RANGE: &'static str = "from 1 ps to 86400 s";
    fn allows(value: f64) -> bool {
        (1e-12..=86_400.0).contains(&value)
    }
}

/// A size of memory, from a byte on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SizeKind;

impl Kind for SizeKind {
    const NAME: &'static str = "a size";
    const DIMENSION: Dimension = Dimension::Bytes;
    const EXAMPLE: &'static str = "8 MiB";
    const RANGE: &'static str = "from 1 B to 1 GB";
    fn allows(value: f64) -> bool {
        (1.0..=1e9).contains(&value)
    }
}

/// An absorption of light a metre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AbsorptionKind;

impl Kind for AbsorptionKind {
    const NAME: &'static str = "an absorption";
    const DIMENSION: Dimension = Dimension::PerLength;
    const EXAMPLE: &'static str = "0.5 /m";
    const RANGE: &'static str = "from 0 /m to 1e9 /m";
    fn allows(value: f64) -> bool {
        (0.0..=1e9).contains(&value)
    }
}

/// Bytes a second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RateKind;

impl Kind for RateKind {
    const NAME: &'static str = "a bandwidth";
    const DIMENSION: Dimension = Dimension::Bandwidth;
    const EXAMPLE: &'static str = "10 Mbit/s";
    const RANGE: &'static str = "from 1 B/s to 1000 GB/s";
    fn allows(value: f64) -> bool {
        (1.0..=1e12).contains(&value)
    }
}

/// A number with its unit, as text in a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity<K> {
    text: String,
    value: f64,
    kind: PhantomData<K>,
}

/// A length, in metres.
pub type Length = Quantity<LengthKind>;
/// A share, from 0 to 1.
pub type Fraction = Quantity<FractionKind>;
/// A span of virtual time, in seconds.
pub type Period = Quantity<PeriodKind>;
/// An absorption of light, 1/m.
pub type Absorption = Quantity<AbsorptionKind>;
/// A size of memory, in bytes.
pub type Size = Quantity<SizeKind>;
/// A bandwidth, in bytes a second.
pub type Rate = Quantity<RateKind>;

impl<K: Kind> Quantity<K> {
    /// Reads text such as "0.30 m".
    ///
    /// # Errors
    /// If the text is no quantity of this kind, or its value is not allowed.
    pub fn parse(text: &str) -> Result<Quantity<K>, String> {
        let value = quantity::parse(text, K::DIMENSION).map_err(|error| error.to_string())?;
        if !K::allows(value) {
            return Err(format!("found \"{text}\"; expected {} {}", K::NAME, K::RANGE));
        }
        Ok(Quantity { text: text.to_owned(), value, kind: PhantomData })
    }

    /// The value in the base unit: metres, 1/m, seconds, bytes, bytes a second, or a fraction of 1.
    pub fn value(&self) -> f64 {
        self.value
    }
}

impl<'de, K: Kind> Deserialize<'de> for Quantity<K> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Quantity<K>, D::Error> {
        match Value::deserialize(deserializer)? {
            Value::String(text) => Quantity::parse(&text).map_err(D::Error::custom),
            other => Err(D::Error::custom(format!(
                "found {other} without a unit; expected {} as text, such as \"{}\"",
                K::NAME,
                K::EXAMPLE
            ))),
        }
    }
}

impl<K> Serialize for Quantity<K> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.text)
    }
}

impl<K: Kind> JsonSchema for Quantity<K> {
    fn schema_name() -> Cow<'static, str> {
        K::NAME.into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "string", "pattern": "^ *[0-9.]", "examples": [K::EXAMPLE] })
    }
}

/// Some counts, one an axis, as text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counts<const N: usize>(pub [u32; N]);

/// Three counts, such as "14x4x1".
pub type Triple = Counts<3>;
/// Two counts, such as "8x8".
pub type Pair = Counts<2>;

impl<const N: usize> Counts<N> {
    /// An example, for messages and schemas.
    const EXAMPLE: &str = if N == 3 { "14x4x1" } else { "8x8" };
    const NUMBER: &str = if N == 3 { "three" } else { "two" };

    /// Reads text such as "14x4x1".
    ///
    /// # Errors
    /// If the text is not so many whole numbers, 1 to 4096 each.
    pub fn parse(text: &str) -> Result<Counts<N>, String> {
        let counts: Option<Vec<u32>> = text.split('x').map(|n| n.trim().parse().ok()).collect();
        counts
            .and_then(|counts| <[u32; N]>::try_from(counts).ok())
            .filter(|counts| counts.iter().all(|n| (1..=4096).contains(n)))
            .map(Counts)
            .ok_or_else(|| {
                let (number, example) = (Self::NUMBER, Self::EXAMPLE);
                let counts = format!("{number} counts of 1 to 4096");
                format!("\"{text}\" is not {counts}; expected such as \"{example}\"")
            })
    }

    /// How many boxes there are in all.
    pub fn product(self) -> u64 {
        self.0.iter().map(|&n| u64::from(n)).product()
    }
}

impl<const N: usize> fmt::Display for Counts<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.map(|n| n.to_string()).join("x"))
    }
}

impl<'de, const N: usize> Deserialize<'de> for Counts<N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Counts<N>, D::Error> {
        Counts::parse(&String::deserialize(deserializer)?).map_err(D::Error::custom)
    }
}

impl<const N: usize> Serialize for Counts<N> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<const N: usize> JsonSchema for Counts<N> {
    fn schema_name() -> Cow<'static, str> {
        if N == 3 { "Triple" } else { "Pair" }.into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let counts = format!("^{}$", ["[1-9][0-9]*"; N].join("x"));
        json_schema!({ "type": "string", "pattern": counts, "examples": [Self::EXAMPLE] })
    }
}
