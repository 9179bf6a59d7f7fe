//! Reading of files: names, JSON, units, digests, and messages about what is wrong.
//!
//! - [`fault`]: Bad input: file, line, place and what was expected.
//! - [`place`]: Where a value stands in a JSON document.
//! - [`json`]: JSON text without keys named twice, and the line of a place.
//! - [`document`]: A JSON file with `--set` arguments laid over it.
//! - [`quantity`]: Numbers with units.
//! - [`schema`]: JSON Schemas of our files.
//! - [`file`]: Reading and writing of whole files.
//! - [`find`]: Names of scenes, machines and references.
//! - [`digest`]: SHA-256 digests.

pub mod digest;
pub mod document;
pub mod fault;
pub mod file;
pub mod find;
pub mod json;
pub mod place;
pub mod quantity;
pub mod schema;
