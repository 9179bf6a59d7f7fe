//! The machine: its file, checked, and running.

mod caches; // checks the caches of a machine file
mod changes; // what experiments change of a machine
mod file; // the structure of a machine file, and its schema
mod machine; // a machine file, checked
mod multicomputer; // a machine that runs
mod network; // checks the network of a machine file

pub use changes::{machine_changes_schema, with_source};
pub use file::machine_schema;
pub use machine::{Machine, MachineError, Published};
pub use multicomputer::Multicomputer;
