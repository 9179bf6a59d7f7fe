//! Machine files, of which one may say only what it changes of another.

use std::path::Path;

use multicomputer::{Machine, MachineError};
use serde_json::Value;

use crate::files::digest::FileDigest;
use crate::files::fault::Fault;
use crate::files::file;
use crate::files::find::{FileKind, Found, find};

/// A longer row of machines that extend each other can only be a circle.
const LONGEST_ROW: usize = 8;

/// A machine, and the files that it was read from.
pub struct MachineFile {
    /// The machine.
    pub machine: Machine,
    /// The whole machine as one file would say it; the file's own text if it extends none.
    pub text: String,
    /// The file, and then those that it extends.
    pub digests: Vec<FileDigest>,
}

impl MachineFile {
    /// Reads a machine from its file, and what that says to extend from there.
    ///
    /// # Errors
    /// What is wrong, and where.
    pub fn load(found: &Found) -> Result<MachineFile, Fault> {
        let mut text = file::read_text(&found.path)?;
        let mut digests = vec![FileDigest::of_bytes(text.as_bytes(), &found.label)];
        let mut here = found.clone();
        let mut whole = serde_json::from_str::<Value>(&text).unwrap_or_default();
        while let Some(Value::String(base)) = take(&mut whole, "extends") {
            let fault = |message| Fault::of_file(format!("{}: extends", here.label), message);
            if digests.len() == LONGEST_ROW {
                return Err(fault(format!("found \"{base}\"; expected an end of the row")));
            }
            let folder = here.path.parent().unwrap_or(Path::new(""));
            here = find(folder, FileKind::Machines, &base).map_err(fault)?;
            let base = file::read_text(&here.path)?;
            digests.push(FileDigest::of_bytes(base.as_bytes(), &here.label));
            let mut base: Value = serde_json::from_str(&base)
                .map_err(|error| Fault::of_file(&here.label, error.to_string()))?;
            lay_over(&mut base, whole);
            whole = base;
            text = whole.to_string();
        }
        let machine = Machine::from_json(&text, &found.label).map_err(|error| match error {
            // The lines of a text that nobody has written help nobody.
            MachineError::File(mut fault) if digests.len() > 1 => {
                fault.line_and_column = None;
                Fault::complete(fault)
            }
            error => Fault::complete(error),
        })?;
        Ok(MachineFile { machine, text, digests })
    }
}

fn take(value: &mut Value, key: &str) -> Option<Value> {
    value.as_object_mut()?.remove(key)
}

/// Changes what the patch names, by RFC 7396: objects field by field, and null takes a field away.
fn lay_over(value: &mut Value, patch: Value) {
    match (value, patch) {
        (Value::Object(fields), Value::Object(changes)) => {
            for (name, change) in changes {
                match change {
                    Value::Null => drop(fields.shift_remove(&name)),
                    change => lay_over(fields.entry(name).or_insert(Value::Null), change),
                }
            }
        }
        (value, patch) => *value = patch,
    }
}
