//! Reads JSON values as Rust types. Errors name the place and say in plain words what was expected.

use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::fault::{Fault, unknown};
use crate::place::Place;
use crate::schema;

/// Reads a value as a `T`.
///
/// # Errors
/// If the value is not a `T`: its place, and what was expected there. The caller adds the name of the file.
pub fn read<T: DeserializeOwned>(value: &Value) -> Result<T, Fault> {
    serde_path_to_error::deserialize(value).map_err(|error| {
        Fault::at(Place::from(error.path()), in_plain_words(&error.inner().to_string()))
    })
}

/// Refuses keys that a type does not have; `schema` is the schema of the type.
///
/// # Errors
/// The first such key, and the keys that the type has. The caller adds the name of the file.
pub fn refuse_unknown_keys(schema: &Value, value: &Value) -> Result<(), Fault> {
    // serde accepts a list in place of a struct and reads its items as the fields in order.
    if value.is_array() && schema.get("type").is_some_and(|kind| kind == "object") {
        return Err(Fault::at(Place::default(), "found a list; expected an object"));
    }
    unknown_key(schema, value, &Place::default()).map_or(Ok(()), Err)
}

/// The first key under `value` that `schema` does not list.
fn unknown_key(schema: &Value, value: &Value, place: &Place) -> Option<Fault> {
    match value {
        Value::Object(object) => object.iter().find_map(|(key, inner)| {
            let place = place.key(key);
            match schema::field(schema, key) {
                Ok(schema) => unknown_key(schema?, inner, &place),
                Err(known) => Some(Fault::at(place, unknown("field", key, &known))),
            }
        }),
        Value::Array(items) => {
            let schema = schema::items(schema)?;
            let mut items = items.iter().enumerate();
            items.find_map(|(i, inner)| unknown_key(schema, inner, &place.item(i)))
        }
        _ => None,
    }
}

/// serde's message in the words of the other messages.
fn in_plain_words(message: &str) -> String {
    let (kind, rest) = message.split_once('`').unwrap_or((message, ""));
    let (name, rest) = rest.split_once('`').unwrap_or((rest, ""));
    let names = || rest.split('`').skip(1).step_by(2).map(str::to_owned).collect::<Vec<_>>();
    match kind {
        "unknown variant " => unknown("value", name, &names()),
        "unknown field " => unknown("field", name, &names()),
        "missing field " => format!("\"{name}\" is missing; expected it"),
        _ => found_and_expected(message).unwrap_or_else(|| message.to_owned()),
    }
}

/// "invalid type: string \"many\", expected u32" in plain words; none for another message.
fn found_and_expected(message: &str) -> Option<String> {
    let (kind, rest) = message.strip_prefix("invalid ")?.split_once(' ')?;
    let (found, expected) = rest.rsplit_once(", expected ")?;
    let found = match found.split_once(' ').unwrap_or((found, "")) {
        _ if kind == "length" => format!("{found} values"),
        ("string", text) => text.to_owned(),
        ("sequence", "") => "a list".to_owned(),
        ("map", "") => "an object".to_owned(),
        ("unit", _) | ("null", "") => "null".to_owned(),
        (_, number) if number.starts_with('`') => number.trim_matches('`').to_owned(),
        (_, number) => number.strip_prefix("point `").unwrap_or(found).trim_matches('`').to_owned(),
    };
    let expected = match expected {
        "u8" | "u16" | "u32" | "u64" | "usize" => "a whole number, 0 or more",
        "a nonzero u8" => "a whole number, 1 to 255",
        "a nonzero u16" => "a whole number, 1 to 65535",
        "a nonzero u32" => "a whole number, 1 to 4294967295",
        "f64" => "a number",
        "a boolean" => "true or false",
        "string or map" => "a string or an object",
        "a map" => "an object",
        _ if expected.starts_with("struct ") => "an object",
        "a sequence" => "a list",
        other => &other.replace("an array of length ", "a list of "),
    };
    Some(format!("found {found}; expected {expected}"))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use schemars::JsonSchema;
    use serde::Deserialize;
    use serde_json::json;

    use super::*;

    #[derive(Debug, Deserialize, JsonSchema)]
    #[serde(deny_unknown_fields)]
    #[allow(dead_code, reason = "read in tests only")]
    struct File {
        inner: Option<Inner>,
        named: Option<BTreeMap<String, Inner>>,
        list: Option<Vec<Inner>>,
    }

    #[derive(Debug, Deserialize, JsonSchema)]
    #[serde(deny_unknown_fields)]
    #[allow(dead_code, reason = "read in tests only")]
    struct Inner {
        count: u32,
    }

    #[derive(Debug, Deserialize)]
    #[serde(rename_all = "snake_case")]
    enum Colour {
        Red,
        Green,
    }

    #[test]
    fn unknown_keys_are_found_at_any_depth() {
        for (value, place) in [
            (json!({ "outer": 1 }), "outer"),
            (json!({ "inner": { "counts": 1 } }), "inner.counts"),
            (json!({ "named": { "a": { "count": 1 }, "b": { "counts": 1 } } }), "named.b.counts"),
            (json!({ "list": [{ "count": 1 }, { "counts": 1 }] }), "list[1].counts"),
        ] {
            let fault = refuse_unknown_keys(&schema::of::<File>(), &value).unwrap_err();
            assert_eq!(fault.place.to_string(), place);
        }
        let message = refuse_unknown_keys(&schema::of::<Inner>(), &json!({ "cuont": 1 }))
            .unwrap_err()
            .message;
        assert_eq!(message, "unknown field \"cuont\", did you mean \"count\"? (there are: count)");
        assert!(
            refuse_unknown_keys(&schema::of::<File>(), &json!({ "named": { "any": null } }))
                .is_ok()
        );
    }

    #[test]
    fn values_of_a_wrong_type_are_refused_in_plain_words() {
        let fault = read::<File>(&json!({ "list": [{ "count": -1 }] })).unwrap_err();
        let message = "found -1; expected a whole number, 0 or more";
        assert_eq!(fault.to_string(), format!("list[0].count: {message}"));
        for (value, message) in [
            (json!({}), "\"count\" is missing; expected it"),
            (json!({ "count": "many" }), "found \"many\"; expected a whole number, 0 or more"),
            (json!({ "count": 0.5 }), "found 0.5; expected a whole number, 0 or more"),
            (json!({ "count": true }), "found true; expected a whole number, 0 or more"),
            (json!({ "count": null }), "found null; expected a whole number, 0 or more"),
            (json!({ "count": [] }), "found a list; expected a whole number, 0 or more"),
            (json!({ "count": {} }), "found an object; expected a whole number, 0 or more"),
            (json!("x"), "found \"x\"; expected an object"),
        ] {
            assert_eq!(read::<Inner>(&value).unwrap_err().message, message);
        }
        let colour = |value| read::<Colour>(&value).unwrap_err().message;
        let message = "unknown value \"rde\", did you mean \"red\"? (there are: red, green)";
        assert_eq!(colour(json!("rde")), message);
        assert_eq!(colour(json!(5)), "found 5; expected a string or an object");
        let corner = read::<[f64; 3]>(&json!([1, 2])).unwrap_err().message;
        assert_eq!(corner, "found 2 values; expected a list of 3");
        let message = refuse_unknown_keys(&schema::of::<File>(), &json!([])).unwrap_err().message;
        assert_eq!(message, "found a list; expected an object");
    }
}
