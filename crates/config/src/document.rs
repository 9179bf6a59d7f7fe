//! A JSON file as the user wrote it, with the arguments that change it. It finds the line of a fault.

use std::fmt::Display;
use std::path::Path;

use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

use crate::fault::Fault;
use crate::file::read_text;
use crate::json;
use crate::place::Place;
use crate::read::{read, refuse_unknown_keys};
use crate::schema;

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
    /// Reads a file: [`read_text`], [`Document::parse`].
    pub fn read(path: &Path) -> Result<Document, Fault> {
        Document::parse(path.display(), read_text(path)?)
    }

    /// Takes a file's text; `file` is its name for messages.
    ///
    /// # Errors
    /// If the text is not JSON, or names a key of an object twice.
    pub fn parse(file: impl Display, text: String) -> Result<Document, Fault> {
        let file = file.to_string();
        let value = json::parse(&text).map_err(|fault| Fault { file: file.clone(), ..fault })?;
        Ok(Document { file, value, text, arguments: Vec::new() })
    }

    /// Lays `path=value` over the file: `path` is dotted keys, `value` JSON or bare text. A path that leads into a
    /// list is followed in each of its items.
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
        let keys: Vec<&str> = path.split('.').collect();
        if !put(&mut self.value, &keys, &value) {
            return refuse("the path leads into a value that has no fields");
        }
        self.arguments.push((Place::of(path), argument.to_owned()));
        Ok(())
    }

    /// The whole document as a `T`.
    ///
    /// # Errors
    /// If it has fields that a `T` has not, or is not a `T`.
    pub fn read_as<T: DeserializeOwned + JsonSchema>(&self) -> Result<T, Fault> {
        refuse_unknown_keys(&schema::of::<T>(), &self.value)
            .and_then(|()| read(&self.value))
            .map_err(|fault| self.locate(fault))
    }

    /// A fault at a place of this document, with its line, or the argument that set it.
    pub fn fault(&self, place: &Place, message: impl Into<String>) -> Fault {
        let fault = Fault::at(place.clone(), message);
        // An argument around the place, or inside it, unless that is the whole document.
        let at = |set: &Place| set.holds(place) || !place.0.is_empty() && place.holds(set);
        match self.arguments.iter().rev().find(|(set, _)| at(set)) {
            Some((_, argument)) => Fault { file: format!("--set {argument}"), ..fault },
            None => {
                Fault { file: self.file.clone(), line: json::line_of(&self.text, place), ..fault }
            }
        }
    }

    /// The same fault of a value of this document, with file and line.
    pub fn locate(&self, fault: Fault) -> Fault {
        self.fault(&fault.place, fault.message)
    }
}

/// Puts a value where keys lead, in each item of a list; false if they lead into a value without fields.
fn put(target: &mut Value, keys: &[&str], value: &Value) -> bool {
    let Some((key, rest)) = keys.split_first() else {
        *target = value.clone();
        return true;
    };
    if target.is_null() {
        *target = Value::Object(Map::new());
    }
    match target {
        Value::Object(fields) => put(fields.entry(*key).or_insert(Value::Null), rest, value),
        Value::Array(items) if !items.is_empty() => {
            items.iter_mut().all(|item| put(item, keys, value))
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn faults_name_the_line_or_the_argument() {
        let text = "{\n\"a\": {\n\"b\": 1}}".to_owned();
        let mut document = Document::parse("x.json", text).unwrap();
        let place = Place::of("a.b");
        assert_eq!(document.fault(&place, "wrong").to_string(), "x.json:3: a.b: wrong");
        assert_eq!(document.fault(&Place::of("a.c"), "no").to_string(), "x.json:2: a.c: no");
        document.set("a.b=soon").unwrap();
        assert_eq!(document.value, json!({ "a": { "b": "soon" } }));
        let fault = document.locate(Fault::at(place, "wrong"));
        assert_eq!(fault.to_string(), "--set a.b=soon: a.b: wrong");
        let fault = document.fault(&Place::of("a"), "wrong");
        assert_eq!(fault.to_string(), "--set a.b=soon: a: wrong");
        assert!(document.set("a.b.c=1").is_err() && document.set("=1").is_err());
        document.set("a=[{\"b\": 1}, {}, null]").unwrap();
        document.set("a.b=2").unwrap();
        assert_eq!(document.value, json!({ "a": [{ "b": 2 }, { "b": 2 }, { "b": 2 }] }));
        document.set("a=[1, {}]").unwrap();
        assert!(document.set("a.b=2").is_err());
    }
}
