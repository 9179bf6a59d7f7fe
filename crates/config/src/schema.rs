//! JSON Schemas of types, and look-up of fields and items in them.

use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema};
use serde_json::{Map, Value};

/// The schema of a type, without references to other schemas.
pub fn of<T: JsonSchema>() -> Value {
    let settings = SchemaSettings::draft2020_12().with(|s| s.inline_subschemas = true);
    Schema::to_value(settings.into_generator().into_root_schema_for::<T>())
}

/// The schema of a field of an object; `None` if the object's schema does not restrict its fields.
///
/// # Errors
/// The names of all fields, if the schema lists them and `key` is not among them.
pub fn field<'a>(schema: &'a Value, key: &str) -> Result<Option<&'a Value>, Vec<String>> {
    let listed = fields(schema);
    let of_any = || alternative(schema, "additionalProperties").filter(|any| any.is_object());
    match (listed, listed.and_then(|fields| fields.get(key)).or_else(of_any)) {
        (_, Some(schema)) => Ok(Some(schema)),
        (None, None) => Ok(None),
        (Some(fields), None) => Err(fields.keys().cloned().collect()),
    }
}

/// The fields that an object's schema lists.
pub fn fields(schema: &Value) -> Option<&Map<String, Value>> {
    alternative(schema, "properties")?.as_object()
}

/// The schema of a list's items.
pub fn items(schema: &Value) -> Option<&Value> {
    alternative(schema, "items")
}

/// The value of a keyword: the schema's own, or else that of the first alternative that has it.
fn alternative<'a>(schema: &'a Value, keyword: &str) -> Option<&'a Value> {
    schema.get(keyword).or_else(|| {
        let alternatives = schema.get("anyOf").and_then(Value::as_array)?;
        alternatives.iter().find_map(|schema| alternative(schema, keyword))
    })
}
