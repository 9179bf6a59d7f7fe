//! Numbers with units as fields of files.

use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserializer, Error, Visitor};
use serde::{Deserialize, Serialize, Serializer};

use crate::dimension::{Dimension, parse};

/// What a quantity measures, and which values it may have.
pub trait Measure {
    /// Its dimension.
    const DIMENSION: Dimension;
    /// An example, for messages and schemas.
    const EXAMPLE: &'static str = Self::DIMENSION.example();
    /// The values allowed, in words.
    const RANGE: &'static str = Self::DIMENSION.range();

    /// Whether a value, in the dimension's SI unit, is allowed.
    fn allows(_value: f64) -> bool {
        true
    }
}

/// Measures that allow every value of their dimension.
macro_rules! measures {
    ($($name:ident)*) => { $(
        #[doc = concat!("[`Dimension::", stringify!($name), "`], any value.")]
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name;

        impl Measure for $name {
            const DIMENSION: Dimension = Dimension::$name;
        }
    )* };
}
measures! { Time Frequency Bandwidth Bytes Cycles }

/// A number with its unit, as text in a file: "50 MHz".
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity<M> {
    text: String,
    value: f64,
    measure: PhantomData<M>,
}

impl<M: Measure> Quantity<M> {
    /// Reads text such as "0.30 m".
    ///
    /// # Errors
    /// If the text is not a quantity of this measure, or its value is not allowed.
    pub fn parse(text: &str) -> Result<Quantity<M>, String> {
        let value = parse(text, M::DIMENSION)?;
        if !M::allows(value) {
            return Err(format!("found {text:?}; expected {} {}", M::DIMENSION.noun(), M::RANGE));
        }
        Ok(Quantity { text: text.to_owned(), value, measure: PhantomData })
    }

    /// The value in the dimension's SI unit.
    pub fn value(&self) -> f64 {
        self.value
    }
}

impl<'de, M: Measure> Deserialize<'de> for Quantity<M> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Quantity<M>, D::Error> {
        deserializer.deserialize_any(QuantityVisitor(PhantomData))
    }
}

struct QuantityVisitor<M>(PhantomData<M>);

impl<M: Measure> QuantityVisitor<M> {
    fn without_unit<E: Error>(found: impl fmt::Display) -> E {
        let (noun, example) = (M::DIMENSION.noun(), M::EXAMPLE);
        E::custom(format!("found {found} without a unit; expected {noun} such as {example:?}"))
    }
}

impl<M: Measure> Visitor<'_> for QuantityVisitor<M> {
    type Value = Quantity<M>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} such as {:?}", M::DIMENSION.noun(), M::EXAMPLE)
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Quantity<M>, E> {
        Quantity::parse(text).map_err(E::custom)
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<Quantity<M>, E> {
        Err(Self::without_unit(number))
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<Quantity<M>, E> {
        Err(Self::without_unit(number))
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<Quantity<M>, E> {
        Err(Self::without_unit(number))
    }
}

impl<M> fmt::Display for Quantity<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl<M> Serialize for Quantity<M> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.text)
    }
}

impl<M: Measure> JsonSchema for Quantity<M> {
    fn schema_name() -> Cow<'static, str> {
        std::any::type_name::<M>().rsplit("::").next().unwrap_or_default().into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let units: Vec<&str> = M::DIMENSION.unit_names().collect();
        json_schema!({
            "type": "string",
            "description": format!("A number with its unit: {}.", units.join(", ")),
            "pattern": format!(r"^\s*\+?[0-9.]+([eE][+-]?[0-9]+)?\s*({})\s*$", units.join("|")),
            "examples": [M::EXAMPLE],
        })
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    struct Share;

    impl Measure for Share {
        const DIMENSION: Dimension = Dimension::Fraction;
        const RANGE: &'static str = "up to 100 %";
        fn allows(value: f64) -> bool {
            value <= 1.0
        }
    }

    #[test]
    fn a_field_is_text_with_a_unit_and_comes_back_as_it_was_written() {
        let read = |value| serde_json::from_value::<Quantity<Time>>(value);
        let time = read(json!("40 ns")).unwrap();
        assert_eq!((time.value(), json!(time)), (40e-9, json!("40 ns")));
        for (value, message) in [
            (json!(-5), "found -5 without a unit; expected a time such as \"40 ns\""),
            (json!(0.5), "found 0.5 without a unit; expected a time such as \"40 ns\""),
            (json!([]), "invalid type: sequence, expected a time such as \"40 ns\""),
        ] {
            assert_eq!(read(value).unwrap_err().to_string(), message);
        }
    }

    #[test]
    fn a_measure_may_allow_less_than_its_dimension() {
        assert!(Quantity::<Share>::parse("100 %").is_ok());
        let message = Quantity::<Share>::parse("101 %").err();
        assert_eq!(message.unwrap(), "found \"101 %\"; expected a fraction up to 100 %");
    }
}
