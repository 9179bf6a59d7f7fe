//! JSON Schemas of our files, so that editors complete them.

use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema};
use serde_json::{Map, Value, json};

/// The schema of a type, complete in itself.
pub fn of<T: JsonSchema>() -> Value {
    let settings = SchemaSettings::draft2020_12().with(|s| s.inline_subschemas = true);
    Schema::to_value(settings.into_generator().into_root_schema_for::<T>())
}

/// Lets every field that holds one value, but for those named, hold a list of such values too.
pub fn sweepable(schema: &mut Value, but: &[&str]) {
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
