//! The JSON Schema of experiment files: the rule of sweeps.

use std::sync::LazyLock;

use config::schema;
use serde_json::{Map, Value, json};

use super::fields::{Experiment, UNSWEPT};

/// The fields of one run, as a schema without lists that sweep.
pub static FIELDS: LazyLock<Value> = LazyLock::new(schema::of::<Experiment>);

/// The schema of an experiment file.
pub fn experiment_schema() -> Value {
    let mut schema = FIELDS.clone();
    sweepable(&mut schema, &[&UNSWEPT[..], &["machine"]].concat());
    if let Some(Value::Array(machine)) = schema.pointer_mut("/properties/machine/anyOf") {
        machine.iter_mut().for_each(|choice| sweepable(choice, &[]));
        let one = json!({ "type": ["string", "object"] });
        machine.push(json!({ "type": "array", "items": one, "minItems": 1, "uniqueItems": true }));
    }
    schema
}

/// Lets every field that holds one value, but for those named, hold a list of such values too.
fn sweepable(schema: &mut Value, but: &[&str]) {
    let Value::Object(schema) = schema else { return };
    if let Some(any @ Value::Object(_)) = schema.get_mut("additionalProperties") {
        allow_list(any, but);
    }
    if let Some(Value::Object(fields)) = schema.get_mut("properties") {
        let swept = fields.iter_mut().filter(|(name, _)| !but.contains(&name.as_str()));
        swept.for_each(|(_, field)| allow_list(field, but));
    }
}

/// Lets a field hold a list, or the fields of an object.
fn allow_list(schema: &mut Value, but: &[&str]) {
    let of_object = ["properties", "additionalProperties"];
    if of_object.iter().any(|key| schema.get(key).is_some_and(Value::is_object)) {
        return sweepable(schema, but);
    }
    let Value::Object(field) = schema else { return };
    let about: Map<String, Value> = ["description", "default"]
        .iter()
        .filter_map(|&key| Some((key.to_owned(), field.remove(key)?)))
        .collect();
    let one = Value::Object(std::mem::replace(field, about));
    let list = json!({ "type": "array", "items": one, "minItems": 1, "uniqueItems": true });
    field.insert("anyOf".to_owned(), json!([one, list]));
}
