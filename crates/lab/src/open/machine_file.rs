//! Reads machine files. A file may extend another one and state only what differs.

use std::path::Path;

use config::{Document, Fault, Place, merge, read_text};
use multicomputer::{Machine, with_source};
use serde_json::Value;

use crate::files::digest::FileDigest;
use crate::files::find::{FileKind, Found, find, find_here};

/// A longer row of machines that extend each other can only be a circle.
const LONGEST_ROW: usize = 8;

/// A machine, as its file and those that it extends describe it.
pub struct MachineFile {
    /// The machine.
    pub machine: Machine,
    /// What results call its file.
    pub label: String,
    /// What its file says, with what it extends.
    pub value: Value,
    /// The file, and then those that it extends.
    pub(crate) digests: Vec<FileDigest>,
}

impl MachineFile {
    /// Reads the machine that a name, or a path to a machine file, means. Unlike an experiment's, it
    /// need not price any operation.
    pub fn open(name: &str) -> Result<MachineFile, Fault> {
        let found = find_here(&FileKind::MACHINES, name).map_err(Fault::complete)?;
        MachineFile::load(&found)
    }

    /// Reads a machine from its file, and what that says to extend from there. Each of these files
    /// must describe a machine by itself, so that a fault is always in the file that is named.
    pub(crate) fn load(found: &Found) -> Result<MachineFile, Fault> {
        MachineFile::within(found, LONGEST_ROW)
    }

    /// The same, for a row of at most `longest` files.
    fn within(found: &Found, longest: usize) -> Result<MachineFile, Fault> {
        let text = read_text(&found.path)?;
        let mut digests = vec![FileDigest::of(text.as_bytes(), &found.label)];
        let mut document = Document::parse(&found.label, text)?;
        if let Some(Value::String(base)) = document.value.get("extends") {
            let fault = |message| document.fault(&Place::of("extends"), message);
            if longest == 1 {
                return Err(fault(format!("found \"{base}\"; expected an end of the row")));
            }
            let folder = found.path.parent().unwrap_or(Path::new(""));
            let base = find(folder, &FileKind::MACHINES, base).map_err(fault)?;
            let base = MachineFile::within(&base, longest - 1)?;
            let mut changes = std::mem::replace(&mut document.value, base.value);
            changes.as_object_mut().and_then(|fields| fields.shift_remove("extends"));
            merge(&mut document.value, changes);
            digests.extend(base.digests);
        }
        let machine = Machine::of(&document.value).map_err(|fault| document.locate(fault))?;
        Ok(MachineFile { machine, label: found.label.clone(), value: document.value, digests })
    }

    /// The machine with an experiment's changes.
    ///
    /// # Errors
    /// What is wrong, and where in the machine. The caller adds the name of the file.
    pub(crate) fn changed(&self, mut changes: Value) -> Result<Machine, Fault> {
        with_source(&mut changes, "the experiment");
        let mut value = self.value.clone();
        merge(&mut value, changes);
        Machine::of(&value)
    }
}
