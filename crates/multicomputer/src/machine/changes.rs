//! Changes of a machine by an experiment: fields of a machine file, with numbers as bare values.

use config::schema;
use serde_json::{Value, json};

use super::file::FIELDS;

/// Gives each bare number of some changes the form that it has in a machine file: an object of the value,
/// how it is known, and `source`.
pub fn with_source(changes: &mut Value, source: &str) {
    give_source(&FIELDS, changes, source);
}

fn give_source(schema: &Value, value: &mut Value, source: &str) {
    if is_sourced(schema) {
        if !value.is_object() && !value.is_null() {
            *value = json!({ "value": value.take() });
        }
        if let Value::Object(fields) = value {
            fields.entry("provenance").or_insert_with(|| "assumed".into());
            fields.entry("source").or_insert_with(|| source.into());
        }
    } else if let Value::Object(fields) = value {
        for (name, inner) in fields {
            if let Ok(Some(schema)) = schema::field(schema, name) {
                give_source(schema, inner, source);
            }
        }
    }
}

/// Whether a field is a number with its provenance and source.
fn is_sourced(schema: &Value) -> bool {
    schema::fields(schema).is_some_and(|fields| fields.contains_key("provenance"))
}

/// The schema of such changes: the fields of a machine file, none of them required; a bare value may be
/// in the place of a number with its provenance and source.
pub fn machine_changes_schema() -> Value {
    let mut schema = FIELDS.clone();
    for about_file in ["$schema", "title", "description"] {
        schema.as_object_mut().and_then(|schema| schema.remove(about_file));
    }
    make_optional(&mut schema);
    schema
}

fn make_optional(schema: &mut Value) {
    // Of an optional field: the field itself, with what is said of it.
    if let Some(field) = schema.get_mut("anyOf").and_then(|any| any.get_mut(0)).map(Value::take) {
        let about = schema["description"].take();
        *schema = field;
        if about.is_string() {
            schema["description"] = about;
        }
    }
    let Value::Object(fields) = schema else { return };
    fields.remove("required");
    fields.remove("default");
    if let Some(value) =
        fields.get("properties").and_then(|inner| inner.get("provenance").and(inner.get("value")))
    {
        let (value, about) = (value.clone(), fields.remove("description"));
        *schema = json!({ "description": about, "anyOf": [value, Value::Object(std::mem::take(fields))] });
        return;
    }
    for (_, inner) in
        fields.get_mut("properties").and_then(Value::as_object_mut).into_iter().flatten()
    {
        make_optional(inner);
    }
    if let Some(any) = fields.get_mut("additionalProperties").filter(|any| any.is_object()) {
        make_optional(any);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bare_numbers_get_the_form_of_a_machine_file() {
        let mut changes = json!({
            "title": "x",
            "processor": { "clock": "40 MHz", "operations": { "ray": "9 cycles" } },
            "node_memory": { "burst": { "value": "4 KiB" }, "system": null },
            "network": { "model": "flit" },
        });
        with_source(&mut changes, "a test");
        let with =
            |value: &str| json!({ "value": value, "provenance": "assumed", "source": "a test" });
        assert_eq!(
            changes,
            json!({
                "title": "x",
                "processor": { "clock": with("40 MHz"), "operations": { "ray": with("9 cycles") } },
                "node_memory": { "burst": with("4 KiB"), "system": null },
                "network": { "model": "flit" },
            })
        );
    }
}
