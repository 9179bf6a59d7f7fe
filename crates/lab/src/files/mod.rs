//! Reading of files: names, units, digests. JSON, places and faults are those of [`config`].

pub mod counts; // Counts along axes, as text.
pub mod digest; // SHA-256 digests.
pub mod file; // Reading and writing of whole files.
pub mod find; // Names of scenes, machines and references.
pub mod quantity; // The quantities of our files, and their ranges.

/// What is wrong with a field of the experiment: its place, and the message.
pub type WrongField = (&'static str, String);
