//! A machine without an experiment, to show and to measure it.

use std::path::Path;

use config::Fault;
use multicomputer::Machine;
use serde_json::Value;

use crate::files::find::{FileKind, find};
use crate::open::machine_file::MachineFile;

/// A machine, and its file.
pub struct OpenMachine {
    /// The machine.
    pub machine: Machine,
    /// What results call its file.
    pub label: String,
    /// What its file says, with what it extends.
    pub value: Value,
}

impl OpenMachine {
    /// Reads the machine that a name, or a path to a machine file, means. Unlike an experiment's, it
    /// need not price any operation.
    pub fn load(name: &str) -> Result<OpenMachine, Fault> {
        let found = find(Path::new("."), &FileKind::MACHINES, name).map_err(Fault::complete)?;
        let MachineFile { machine, value, .. } = MachineFile::load(&found)?;
        Ok(OpenMachine { machine, label: found.label, value })
    }
}
