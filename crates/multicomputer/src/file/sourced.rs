//! Numbers of a machine file: each with its unit, and with where it comes from.

use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;

use desim::Duration;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserializer, Error, Unexpected, Visitor};
use serde::{Deserialize, Serialize};

use super::fault::MachineFault;
use super::quantity::{self, Dimension};

/// How a number is known.
#[derive(Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Provenance {
    /// The source states it.
    Published,
    /// It follows from published figures, as the source says.
    Derived,
    /// It is plausible, for the reason that the source gives.
    Assumed,
    /// It was set so that one result comes out right; the source says which.
    Calibrated,
}

/// A number, how it is known, and where it comes from.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object of value, provenance and source")]
#[schemars(rename = "Sourced{T}")]
pub(crate) struct Sourced<T> {
    /// The number, with its unit where it has one.
    pub(crate) value: T,
    /// How the number is known. Stated for readers; it changes no result.
    #[serde(rename = "provenance")]
    pub(crate) _provenance: Provenance,
    /// Publication, derivation or reasoning; for a calibrated number, on what.
    #[serde(rename = "source", deserialize_with = "some_text")]
    #[schemars(length(min = 1))]
    pub(crate) _source: String,
}

fn some_text<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    let text = String::deserialize(deserializer)?;
    if text.trim().is_empty() {
        return Err(D::Error::invalid_value(
            Unexpected::Str(&text),
            &"where the number comes from",
        ));
    }
    Ok(text)
}

/// A dimension as a type, so that a field says which one it expects.
pub(crate) trait Measure {
    const DIMENSION: Dimension;
}

macro_rules! measures {
    ($($name:ident)*) => { $(
        pub(crate) enum $name {}
        impl Measure for $name {
            const DIMENSION: Dimension = Dimension::$name;
        }
    )* };
}
measures! { Time Frequency Bandwidth Bytes Cycles }

/// A text such as "50 MHz", read; the value is in the measure's SI unit.
pub(crate) struct Quantity<M> {
    pub(crate) si: f64,
    measure: PhantomData<M>,
}

impl Quantity<Time> {
    /// Rounded to ticks of virtual time.
    pub(crate) fn duration(&self) -> Duration {
        Duration::from_seconds_f64(self.si)
    }
}

/// A size in whole bytes, at least one; `place` is that of its field.
pub(crate) fn whole_bytes(
    place: &str,
    size: &Sourced<Quantity<Bytes>>,
) -> Result<u64, MachineFault> {
    let found = size.value.si;
    if (1.0..=1e15).contains(&found) && found.fract() == 0.0 {
        return Ok(found as u64);
    }
    let message = format!("found {found} B; expected a whole number of bytes, at least 1");
    Err(MachineFault::at(format!("{place}.value"), message))
}

impl<'de, M: Measure> Deserialize<'de> for Quantity<M> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_str(QuantityVisitor(PhantomData))
    }
}

struct QuantityVisitor<M>(PhantomData<M>);

impl<M: Measure> Visitor<'_> for QuantityVisitor<M> {
    type Value = Quantity<M>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", M::DIMENSION)
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Quantity<M>, E> {
        let si = quantity::parse(text, M::DIMENSION).map_err(E::custom)?;
        Ok(Quantity { si, measure: PhantomData })
    }
}

impl<M: Measure> JsonSchema for Quantity<M> {
    fn schema_name() -> Cow<'static, str> {
        format!("{:?}", M::DIMENSION).into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let units: Vec<&str> = M::DIMENSION.unit_names().collect();
        json_schema!({
            "type": "string",
            "description": format!("A number with its unit: {}.", units.join(", ")),
            "pattern": format!(r"^\s*\+?[0-9.]+([eE][+-]?[0-9]+)?\s*({})\s*$", units.join("|")),
            "examples": [M::DIMENSION.example()],
        })
    }
}

/// A plain number above zero.
#[derive(Deserialize, JsonSchema)]
#[serde(try_from = "f64")]
#[schemars(extend("exclusiveMinimum" = 0))]
pub(crate) struct Positive(pub(crate) f64);

impl TryFrom<f64> for Positive {
    type Error = String;

    fn try_from(number: f64) -> Result<Positive, String> {
        if number.is_finite() && number > 0.0 {
            Ok(Positive(number))
        } else {
            Err(format!("found {number}; expected a number above zero"))
        }
    }
}
