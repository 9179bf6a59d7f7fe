//! Counts along axes, as text: "14x4x1".

use std::borrow::Cow;
use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserializer, Error};
use serde::{Deserialize, Serialize, Serializer};

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
