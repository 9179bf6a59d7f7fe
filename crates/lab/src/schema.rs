//! JSON Schemas of our files, so that editors complete them.

use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema};
use serde_json::{Map, Value, json};

use crate::experiment::Experiment;
use crate::scene_file::SceneFile;

/// Fields of an experiment file in which a list is no sweep.
pub const UNSWEPT: [&str; 4] = ["$schema", "title", "compare_with", "plots"];

/// The schema of an experiment file.
pub fn experiment_schema() -> Value {
    let mut schema = schema_of::<Experiment>();
    if let Some(Value::Object(fields)) = schema.get_mut("properties") {
        sweepable(fields);
    }
    schema
}

/// The schema of a scene description.
pub fn scene_schema() -> Value {
    schema_of::<SceneFile>()
}

fn schema_of<T: JsonSchema>() -> Value {
    let settings = SchemaSettings::draft2020_12().with(|s| s.inline_subschemas = true);
    Schema::to_value(settings.into_generator().into_root_schema_for::<T>())
}

/// Lets every field that holds one value hold a list of such values too.
fn sweepable(fields: &mut Map<String, Value>) {
    for (name, schema) in fields {
        if UNSWEPT.contains(&name.as_str()) {
            continue;
        }
        let Value::Object(schema) = schema else { continue };
        if let Some(Value::Object(inner)) = schema.get_mut("properties") {
            sweepable(inner);
            continue;
        }
        let about: Map<String, Value> = ["description", "default"]
            .iter()
            .filter_map(|&key| Some((key.to_owned(), schema.remove(key)?)))
            .collect();
        let one = Value::Object(std::mem::take(schema));
        let list = json!({ "type": "array", "items": one, "minItems": 1, "uniqueItems": true });
        *schema = about;
        schema.insert("anyOf".to_owned(), json!([one, list]));
    }
}
