//! The machine: its file, checked, and running.

/// Checks the caches of a machine file.
mod caches;
/// What experiments change of a machine.
mod changes;
/// The structure of a machine file, and its schema.
mod file;
/// A machine file, checked.
mod machine;
/// A machine that runs.
mod multicomputer;

pub use changes::{machine_changes_schema, with_source};
pub use file::machine_schema;
pub use machine::{Machine, MachineError, Published};
pub use multicomputer::Multicomputer;
