//! A machine outside any experiment: to be looked at and measured.

use std::path::Path;

use multicomputer::Machine;

use crate::fault::Fault;
use crate::file;
use crate::find::{Shelf, find};

/// Reads the machine that a name, or a path to a machine file, means. Unlike an experiment's, it need
/// not price any operation.
///
/// # Errors
/// What is wrong, and where.
pub fn open_machine(name: &str) -> Result<Machine, Fault> {
    let found = find(Path::new("."), Shelf::Machines, name).map_err(Fault::complete)?;
    Machine::from_json(&file::read_text(&found.path)?, &found.label).map_err(Fault::complete)
}
