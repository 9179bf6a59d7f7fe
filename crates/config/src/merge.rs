//! Files that extend others, by RFC 7396 (JSON Merge Patch), and defaults.

use serde_json::Value;

/// Lays a patch over a value: objects field by field, null takes a field away, and anything else
/// takes the place of what was there. Fields keep the order of `value`; new ones follow.
pub fn merge(value: &mut Value, patch: Value) {
    match (value, patch) {
        (Value::Object(fields), Value::Object(changes)) => {
            for (name, change) in changes {
                match change {
                    Value::Null => drop(fields.shift_remove(&name)),
                    change => merge(fields.entry(name).or_insert(Value::Null), change),
                }
            }
        }
        // A patch over something that has no fields: its nulls have nothing to take away.
        (value, patch @ Value::Object(_)) => {
            *value = Value::Object(serde_json::Map::new());
            merge(value, patch);
        }
        (value, patch) => *value = patch,
    }
}

/// Gives a value the fields that it lacks, after its own. Nulls count as fields on both sides.
pub fn fill(value: &mut Value, defaults: Value) {
    let (Value::Object(fields), Value::Object(defaults)) = (value, defaults) else { return };
    for (name, default) in defaults {
        match fields.get_mut(&name) {
            Some(field) => fill(field, default),
            None => _ = fields.insert(name, default),
        }
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn a_patch_replaces_adds_and_takes_away() {
        let mut value = json!({ "a": { "b": 1, "c": [1, 2] }, "d": 1 });
        merge(
            &mut value,
            json!({ "d": null, "a": { "c": [3], "e": { "f": 1, "g": null } }, "h": null }),
        );
        assert_eq!(value, json!({ "a": { "b": 1, "c": [3], "e": { "f": 1 } } }));
        merge(&mut value, json!({ "a": { "b": { "x": null, "y": 2 } } }));
        assert_eq!(value["a"]["b"], json!({ "y": 2 }));
        merge(&mut value, json!("x"));
        assert_eq!(value, json!("x"));
    }

    #[test]
    fn defaults_fill_what_is_not_there_and_change_nothing_else() {
        let mut value = json!({ "b": { "x": 1 }, "a": null });
        fill(&mut value, json!({ "a": 1, "b": { "x": 2, "y": 3 }, "c": null }));
        assert_eq!(value.to_string(), r#"{"b":{"x":1,"y":3},"a":null,"c":null}"#);
    }
}
