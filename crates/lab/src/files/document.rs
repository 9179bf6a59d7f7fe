//! A JSON file as the user wrote it, with the arguments that change it, able to say where a
//! fault stands.

use std::path::Path;

use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};
use serde_path_to_error::Segment;

use crate::files::fault::{Fault, unknown};
use crate::files::file;
use crate::files::json;
use crate::files::place::{Place, Step};
use crate::files::schema;

/// A JSON file, with `--set path=value` arguments laid over it.
#[derive(Clone, Debug)]
pub struct Document {
    /// The file, as the user named it.
    pub file: String,
    /// What it says, arguments included.
    pub value: Value,
    text: String,
    arguments: Vec<(Place, String)>,
}

impl Document {
    /// Reads a file.
    ///
    /// # Errors
    /// If it cannot be read, is no JSON, or names a key of an object twice.
    pub fn read(path: &Path) -> Result<Document, Fault> {
        Document::parse(path.display().to_string(), file::read_text(path)?)
    }

    /// Takes a file's text; `file` is its name for messages.
    ///
    /// # Errors
    /// If the text is no JSON, or names a key of an object twice.
    pub fn parse(file: String, text: String) -> Result<Document, Fault> {
        match json::parse(&text) {
            Ok(value @ Value::Object(_)) => {
                Ok(Document { file, value, text, arguments: Vec::new() })
            }
            Ok(other) => Err(Fault::of_file(file, format!("found {other}; expected an object"))),
            Err(error) => Err(Fault {
                file,
                line: Some(error.line()),
                place: Place::default(),
                message: without_position(&error.to_string()),
            }),
        }
    }

    /// Lays `path=value` over the file: `path` is dotted keys, `value` JSON or bare text.
    ///
    /// # Errors
    /// If there is no `=`, or the path leads through a value that is not an object.
    pub fn set(&mut self, argument: &str) -> Result<(), Fault> {
        let refuse = |message| Err(Fault::of_file(format!("--set {argument}"), message));
        let Some((path, text)) = argument.split_once('=').filter(|(path, _)| !path.is_empty())
        else {
            return refuse("expected path=value, such as hemisphere.pixels=4096");
        };
        let value = json::parse(text).unwrap_or_else(|_| Value::String(text.to_owned()));
        let mut target = &mut self.value;
        for key in path.split('.') {
            if target.is_null() {
                *target = Value::Object(Map::new());
            }
            let Value::Object(object) = target else {
                return refuse("the path leads into a value that has no fields");
            };
            target = object.entry(key).or_insert(Value::Null);
        }
        *target = value;
        self.arguments.push((Place::of(path), argument.to_owned()));
        Ok(())
    }

    /// A fault at a place of this document, with its line, or the argument that set it.
    pub fn fault(&self, place: &Place, message: impl Into<String>) -> Fault {
        let (place, message) = (place.clone(), message.into());
        let set = self.arguments.iter().rev().find(|(set, _)| set.holds(&place));
        match set {
            Some((_, argument)) => {
                Fault { file: format!("--set {argument}"), line: None, place, message }
            }
            None => {
                let line = json::line_of(&self.text, &place).filter(|_| !place.0.is_empty());
                Fault { file: self.file.clone(), line, place, message }
            }
        }
    }

    /// Reads `value`, a part of this document, as a `T`; `locate` turns a place in `value` into
    /// one in the document.
    ///
    /// # Errors
    /// If the value is not a `T`: what serde expected, at its place.
    pub fn typed<T: DeserializeOwned>(
        &self,
        value: &Value,
        locate: impl Fn(Place) -> Place,
    ) -> Result<T, Fault> {
        serde_path_to_error::deserialize(value).map_err(|error| {
            let steps = error.path().iter().filter_map(|segment| match segment {
                Segment::Seq { index } => Some(Step::Item(*index)),
                Segment::Map { key } => Some(Step::Key(key.clone())),
                Segment::Enum { .. } | Segment::Unknown => None,
            });
            let place = locate(Place(steps.collect()));
            self.fault(&place, in_plain_words(&error.inner().to_string()))
        })
    }

    /// Refuses the first key that a `T` does not have, with those that it has.
    ///
    /// # Errors
    /// If there is such a key.
    pub fn refuse_unknown_keys<T: JsonSchema>(&self) -> Result<(), Fault> {
        match unknown_key(&schema::of::<T>(), &self.value, &Place::default()) {
            Some((place, message)) => Err(self.fault(&place, message)),
            None => Ok(()),
        }
    }
}

/// The first key under `value` that `schema` does not list.
fn unknown_key(schema: &Value, value: &Value, place: &Place) -> Option<(Place, String)> {
    match value {
        Value::Object(object) => {
            let known = schema.get("properties")?.as_object()?;
            object.iter().find_map(|(key, inner)| match known.get(key) {
                Some(schema) => unknown_key(schema, inner, &place.key(key)),
                None => {
                    let names: Vec<String> = known.keys().cloned().collect();
                    Some((place.key(key), unknown("field", key, &names)))
                }
            })
        }
        Value::Array(items) => {
            let schema = schema.get("items")?;
            let mut items = items.iter().enumerate();
            items.find_map(|(i, inner)| unknown_key(schema, inner, &place.item(i)))
        }
        _ => None,
    }
}

/// serde_json's message without its " at line 3 column 7", which stands before the message.
fn without_position(message: &str) -> String {
    message.rsplit_once(" at line ").map_or(message, |(head, _)| head).to_owned()
}

/// serde's message without Rust's names of types.
fn in_plain_words(message: &str) -> String {
    let Some((head, expected)) = message.rsplit_once("expected ") else {
        return message.to_owned();
    };
    let expected = match expected {
        "u32" | "u64" | "usize" => "a whole number, 0 or more",
        "f64" => "a number",
        _ if expected.starts_with("struct ") => "an object",
        "a sequence" => "a list",
        other => other,
    };
    format!("{head}expected {expected}")
}
