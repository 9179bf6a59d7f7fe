//! Reading of files: names, units, digests. JSON, places and faults are those of [`config`].
//!
//! - [`counts`]: Counts along axes, as text.
//! - [`quantity`]: The quantities of our files, and their ranges.
//! - [`file`]: Reading and writing of whole files.
//! - [`find`]: Names of scenes, machines and references.
//! - [`digest`]: SHA-256 digests.

pub mod counts;
pub mod digest;
pub mod file;
pub mod find;
pub mod quantity;

/// What is wrong with a field of the experiment: its place, and the message.
pub type WrongField = (&'static str, String);
