//! JSON text as a value, no key twice, and the line on which a part of it stands.

use std::collections::BTreeMap;
use std::fmt;

use serde::Deserialize;
use serde::de::{Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde_json::value::RawValue;
use serde_json::{Map, Value};

use crate::files::place::{Place, Step};

/// Reads JSON and refuses an object that names a key twice.
///
/// # Errors
/// serde_json's, with line and column.
pub fn parse(text: &str) -> Result<Value, serde_json::Error> {
    serde_json::from_str::<Strict>(text).map(|strict| strict.0)
}

/// Gives a value the fields that it lacks, after its own.
pub fn fill(value: &mut Value, defaults: Value) {
    let (Value::Object(fields), Value::Object(defaults)) = (value, defaults) else { return };
    for (name, default) in defaults {
        match fields.get_mut(&name) {
            Some(field) => fill(field, default),
            None => _ = fields.insert(name, default),
        }
    }
}

/// The line, from 1, on which the value at `place` begins.
pub fn line_of(text: &str, place: &Place) -> Option<usize> {
    let mut raw: &RawValue = serde_json::from_str(text).ok()?;
    for step in &place.0 {
        raw = match step {
            Step::Key(key) => {
                let fields: BTreeMap<String, &RawValue> = serde_json::from_str(raw.get()).ok()?;
                fields.get(key)?
            }
            Step::Item(index) => {
                let items: Vec<&RawValue> = serde_json::from_str(raw.get()).ok()?;
                items.get(*index)?
            }
        };
    }
    // `raw` borrows from `text`, so the two addresses tell how far into it the value begins.
    let offset = raw.get().as_ptr() as usize - text.as_ptr() as usize;
    Some(1 + text.as_bytes()[..offset].iter().filter(|&&byte| byte == b'\n').count())
}

/// A JSON value that was read without meeting a key twice.
struct Strict(Value);

impl<'de> Deserialize<'de> for Strict {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Strict, D::Error> {
        deserializer.deserialize_any(StrictVisitor).map(Strict)
    }
}

struct StrictVisitor;

impl<'de> Visitor<'de> for StrictVisitor {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a JSON value")
    }

    fn visit_unit<E>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }

    fn visit_bool<E>(self, value: bool) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_u64<E>(self, value: u64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_i64<E>(self, value: i64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_f64<E>(self, value: f64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_str<E>(self, value: &str) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Value, A::Error> {
        let mut list = Vec::new();
        while let Some(Strict(item)) = items.next_element()? {
            list.push(item);
        }
        Ok(Value::Array(list))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Value, A::Error> {
        let mut object = Map::new();
        while let Some(key) = entries.next_key::<String>()? {
            if object.contains_key(&key) {
                return Err(A::Error::custom(format!("the key \"{key}\" stands here twice")));
            }
            let Strict(value) = entries.next_value()?;
            object.insert(key, value);
        }
        Ok(Value::Object(object))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_twice_is_refused_with_its_line() {
        let fault = parse("{\n \"a\": 1,\n \"b\": {\"c\": 1, \"c\": 2}\n}").unwrap_err();
        assert!(
            fault.to_string().starts_with("the key \"c\" stands here twice at line 3"),
            "{fault}"
        );
    }

    #[test]
    fn lines_of_values() {
        let text = "{\n \"a\": [1,\n  2],\n \"b\\n\": {\n\"c\": 3}}";
        assert_eq!(line_of(text, &Place::of("a").item(1)), Some(3));
        assert_eq!(line_of(text, &Place::default().key("b\n").key("c")), Some(5));
        assert_eq!(line_of(text, &Place::of("nothing")), None);
        assert_eq!(line_of("{", &Place::default()), None);
    }

    #[test]
    fn values_come_out_as_serde_json_reads_them() {
        let text = r#"{"b": [1, -2, 0.1, null, true, "x"], "a": {}}"#;
        assert_eq!(parse(text).unwrap(), serde_json::from_str::<Value>(text).unwrap());
    }
}
