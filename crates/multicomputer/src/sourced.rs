//! Numbers of a machine file: each with its unit, and with where it comes from.

use config::{Bytes, Fault, Measure, Place, Quantity, Time};
use desim::Duration;
use schemars::JsonSchema;
use serde::de::{Deserializer, Error, Unexpected};
use serde::{Deserialize, Serialize};

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

impl Sourced<Quantity<Time>> {
    /// The time, rounded to ticks of virtual time.
    pub(crate) fn duration(&self) -> Duration {
        Duration::from_seconds_f64(self.si())
    }
}

impl<M: Measure> Sourced<Quantity<M>> {
    /// The number in the measure's SI unit.
    pub(crate) fn si(&self) -> f64 {
        self.value.value()
    }
}

/// A size in whole bytes, at least one; `place` is that of its field.
pub(crate) fn whole_bytes(place: &str, size: &Sourced<Quantity<Bytes>>) -> Result<u64, Fault> {
    let found = size.si();
    if (1.0..=1e15).contains(&found) && found.fract() == 0.0 {
        return Ok(found as u64);
    }
    let message = format!("found {found} B; expected a whole number of bytes, at least 1");
    Err(Fault::at(Place::of(place).key("value"), message))
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
