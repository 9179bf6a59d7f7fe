//! The JSON Schema of experiment files: the rule of sweeps.

use config::schema;
use serde_json::{Map, Value, json};

use super::fields::{Experiment, UNSWEPT};

/// The schema of an experiment file.
pub fn experiment_schema() -> Value {
    let mut schema = schema::of::<Experiment>();
    sweepable(&mut schema, &UNSWEPT);
    schema
}

/// Lets every field that holds one value, but for those named, hold a list of such values too.
fn sweepable(schema: &mut Value, but: &[&str]) {
    let Some(Value::Object(fields)) = schema.get_mut("properties") else { return };
    for (_, schema) in fields.iter_mut().filter(|(name, _)| !but.contains(&name.as_str())) {
        if schema.get("properties").is_some() {
            sweepable(schema, but);
            continue;
        }
        let Value::Object(field) = schema else { continue };
        let about: Map<String, Value> = ["description", "default"]
            .iter()
            .filter_map(|&key| Some((key.to_owned(), field.remove(key)?)))
            .collect();
        let one = Value::Object(std::mem::replace(field, about));
        let list = json!({ "type": "array", "items": one, "minItems": 1, "uniqueItems": true });
        field.insert("anyOf".to_owned(), json!([one, list]));
    }
}
