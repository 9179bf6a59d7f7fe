//! The fields of experiment, machine and scene files, from the schemas of these files.

use multicomputer::machine_schema;
use serde_json::Value;

use crate::experiment::schema::FIELDS;
use crate::glossary::entry::{Entry, Term};
use crate::open::scene_file::scene_schema;

/// What stands in a path for a name that the file chooses.
pub const ANY: &str = "NAME";

/// All fields, by their dotted paths: "stop.patch_threshold".
pub fn fields() -> Vec<Entry> {
    let files = [
        (Term::ExperimentField, FIELDS.clone()),
        (Term::MachineField, machine_schema()),
        (Term::SceneField, scene_schema()),
    ];
    let mut found = Vec::new();
    for (term, schema) in &files {
        Walk { term: *term, root: schema, found: &mut found }.inside(schema, "", "");
    }
    found
}

/// The models of the network.
pub fn network_models() -> Vec<Entry> {
    let schema = machine_schema();
    let models = schema["$defs"]["ModelChoice"]["oneOf"].as_array().into_iter().flatten();
    let entry = |model: &Value| {
        let text = |key: &str| model[key].as_str().unwrap_or_default().to_owned();
        let entry = Entry::new(Term::NetworkModel, text("const"), &text("description"));
        entry.with(
            "field",
            "network.model of a machine file, machine.network.model of an experiment",
        )
    };
    models.map(entry).collect()
}

struct Walk<'a> {
    term: Term,
    root: &'a Value,
    found: &'a mut Vec<Entry>,
}

impl<'a> Walk<'a> {
    /// Adds the fields of an object; `of_all` says what fields are whose names the file chooses.
    fn inside(&mut self, schema: &'a Value, path: &str, of_all: &'a str) {
        for schema in self.alternatives(schema) {
            for (name, field) in schema["properties"].as_object().into_iter().flatten() {
                let path = if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
                self.field(field, &path, "");
            }
            if schema["additionalProperties"].is_object() {
                self.field(&schema["additionalProperties"], &format!("{path}.{ANY}"), of_all);
            }
            if schema["items"].is_object() {
                self.inside(&schema["items"], path, of_all);
            }
        }
    }

    fn field(&mut self, schema: &'a Value, path: &str, otherwise: &'a str) {
        let alternatives = self.alternatives(schema);
        let sourced = alternatives.iter().any(|schema| is_sourced(schema));
        // What the type of a sourced number is says nothing of this field.
        let types = alternatives.iter().copied().filter(|_| !sourced);
        let mut texts = [schema].into_iter().chain(types);
        let about = texts.find_map(|schema| schema["description"].as_str()).unwrap_or(otherwise);
        let entry = Entry::new(self.term, path, about);
        let entry = entry.with("takes", self.values(&alternatives));
        self.found.push(match &schema["default"] {
            Value::Null | Value::Object(_) => entry,
            Value::String(text) => entry.with("default", text),
            other => entry.with("default", other.to_string()),
        });
        // The fields of a machine have entries of their own, and so has no part of a sourced number.
        let machine = self.term == Term::ExperimentField && path == "machine";
        if !machine && !sourced {
            self.inside(schema, path, about);
        }
    }

    /// The schema, or those of which it is any, with their references followed, but for null.
    fn alternatives(&self, schema: &'a Value) -> Vec<&'a Value> {
        if let Some(name) = schema["$ref"].as_str() {
            let target = name.strip_prefix('#').and_then(|pointer| self.root.pointer(pointer));
            return target.map_or(Vec::new(), |target| self.alternatives(target));
        }
        match schema["anyOf"].as_array() {
            // Beside fields it says which of them have to be there.
            Some(any) if schema["properties"].is_null() => {
                any.iter().flat_map(|schema| self.alternatives(schema)).collect()
            }
            _ if schema["type"] == "null" => Vec::new(),
            _ => vec![schema],
        }
    }

    /// What values a field takes, in words.
    fn values(&self, alternatives: &[&'a Value]) -> String {
        let words = alternatives.iter().map(|schema| match is_sourced(schema) {
            true => {
                let number = self.values(&self.alternatives(&schema["properties"]["value"]));
                format!("{number}, with its provenance and source")
            }
            false => value(schema),
        });
        words.collect::<Vec<_>>().join(", or ")
    }
}

/// Whether a schema is that of a number with its provenance.
fn is_sourced(schema: &Value) -> bool {
    ["value", "provenance", "source"].iter().all(|key| schema["properties"].get(key).is_some())
}

/// A value of a schema without alternatives, in words.
fn value(schema: &Value) -> String {
    if let Some(names) = schema["oneOf"].as_array() {
        let text = |name: &Value, key: &str| name[key].as_str().unwrap_or_default().to_owned();
        let name =
            |name: &Value| format!("\"{}\" ({})", text(name, "const"), text(name, "description"));
        return names.iter().map(name).collect::<Vec<_>>().join(", or ");
    }
    let example = schema["examples"][0].as_str().map(|text| format!(", such as \"{text}\""));
    let example = example.unwrap_or_default();
    let kinds = &schema["type"];
    let kind = kinds.as_str().or_else(|| kinds.as_array()?.iter().find_map(Value::as_str));
    let what = match (kind, schema["pattern"].as_str().and_then(units)) {
        (Some("string"), Some(units)) => format!("a number with its unit ({units})"),
        (Some("string"), None) => "a text".to_owned(),
        (Some("integer"), _) => "a whole number".to_owned(),
        (Some("number"), _) => "a number".to_owned(),
        (Some("boolean"), _) => "true or false".to_owned(),
        (Some("array"), _) => "a list".to_owned(),
        _ => "an object".to_owned(),
    };
    what + &example
}

/// The units that the pattern of a quantity allows.
fn units(pattern: &str) -> Option<String> {
    let (_, units) = pattern.strip_suffix(r")\s*$")?.rsplit_once('(')?;
    Some(units.replace('|', ", "))
}
