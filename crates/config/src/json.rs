//! JSON text as a value, no key twice, and the line on which a part of it begins.

use std::collections::BTreeMap;
use std::fmt;

use serde::Deserialize;
use serde::de::{Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde_json::value::RawValue;
use serde_json::{Map, Value};

use crate::fault::Fault;
use crate::place::{Place, Step};

/// Reads JSON and refuses an object that names a key twice.
///
/// # Errors
/// What is wrong, with line, column and place. The caller adds the name of the file.
pub fn parse(text: &str) -> Result<Value, Fault> {
    let fault = |place, error: &serde_json::Error| {
        let message = error.to_string();
        let message = message.rsplit_once(" at line ").map_or(message.as_str(), |(head, _)| head);
        let (line, column) = (Some(error.line()), Some(error.column()));
        Fault { line, column, ..Fault::at(place, message) }
    };
    let mut json = serde_json::Deserializer::from_str(without_mark(text));
    let Strict(value) = serde_path_to_error::deserialize(&mut json)
        .map_err(|error| fault(Place::from(error.path()), error.inner()))?;
    json.end().map_err(|error| fault(Place::default(), &error))?;
    Ok(value)
}

/// A text without the byte order mark with which some editors begin files.
pub fn without_mark(text: &str) -> &str {
    text.strip_prefix('\u{feff}').unwrap_or(text)
}

/// The line, from 1, on which the value at `place` begins, or else the innermost value around it that
/// is there; none if that is the whole text.
pub fn line_of(text: &str, place: &Place) -> Option<usize> {
    let mut raw: &RawValue = serde_json::from_str(without_mark(text)).ok()?;
    let whole = raw.get();
    for step in &place.0 {
        let inner = match step {
            Step::Key(key) => serde_json::from_str::<BTreeMap<String, &RawValue>>(raw.get())
                .ok()
                .and_then(|fields| fields.get(key).copied()),
            Step::Item(index) => serde_json::from_str::<Vec<&RawValue>>(raw.get())
                .ok()
                .and_then(|items| items.get(*index).copied()),
        };
        match inner {
            Some(inner) => raw = inner,
            None => break,
        }
    }
    if raw.get() == whole {
        return None;
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
                return Err(A::Error::custom(format!(
                    "found the key \"{key}\" twice; expected it once"
                )));
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
        assert_eq!((fault.line, fault.place.to_string()), (Some(3), "b".to_owned()));
        assert_eq!(fault.message, "found the key \"c\" twice; expected it once");
    }

    #[test]
    fn what_is_no_json_is_refused_with_line_and_column() {
        for (text, message) in [
            ("", ":1:0: EOF while parsing a value"),
            ("{\n \"a\": }", ":2:7: a: expected value"),
            ("{}\n}", ":2:1: trailing characters"),
        ] {
            assert_eq!(parse(text).unwrap_err().to_string(), message);
        }
    }

    #[test]
    fn lines_of_values() {
        let text = "{\n \"a\": [1,\n  2],\n \"b\\n\": {\n\"c\": 3}}";
        assert_eq!(line_of(text, &Place::of("a").item(1)), Some(3));
        assert_eq!(line_of(text, &Place::default().key("b\n").key("c")), Some(5));
        assert_eq!(line_of(text, &Place::of("a").item(7)), Some(2));
        assert_eq!(line_of(text, &Place::default()), None);
        assert_eq!(line_of(text, &Place::of("nothing")), None);
        assert_eq!(line_of("{", &Place::default()), None);
    }

    #[test]
    fn a_byte_order_mark_is_skipped() {
        let text = "\u{feff}{\n \"a\": 1}";
        assert_eq!(parse(text).unwrap(), parse("{\"a\": 1}").unwrap());
        assert_eq!(line_of(text, &Place::of("a")), Some(2));
        assert!(parse("\u{feff}\u{feff}1").is_err());
    }

    #[test]
    fn values_come_out_as_serde_json_reads_them() {
        let text = r#"{"b": [1, -2, 0.1, null, true, "x"], "a": {}}"#;
        assert_eq!(parse(text).unwrap(), serde_json::from_str::<Value>(text).unwrap());
    }
}
