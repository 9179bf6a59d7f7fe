//! JSON Schemas of types, and the ways down into them.

use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema};
use serde_json::{Map, Value};

/// The schema of a type, complete in itself.
pub fn of<T: JsonSchema>() -> Value {
    let settings = SchemaSettings::draft2020_12().with(|s| s.inline_subschemas = true);
    Schema::to_value(settings.into_generator().into_root_schema_for::<T>())
}

/// The schema of a field of an object; none where the object's schema does not say.
///
/// # Errors
/// The fields that there are, if the schema lists them and this one is not among them.
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

/// What the schema says under a keyword, or else its first alternative that says something there.
fn alternative<'a>(schema: &'a Value, keyword: &str) -> Option<&'a Value> {
    schema.get(keyword).or_else(|| {
        let alternatives = schema.get("anyOf").and_then(Value::as_array)?;
        alternatives.iter().find_map(|schema| alternative(schema, keyword))
    })
}
