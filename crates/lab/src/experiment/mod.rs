//! An experiment file: its fields, and the product of its lists.
//!
//! - [`fields`]: The fields of an experiment file.
//! - [`machine`]: Field `machine`.
//! - [`hemisphere`]: Field `hemisphere`.
//! - [`refine`]: Field `refine`.
//! - [`source_split`]: Field `source_split`.
//! - [`interfaces`]: Fields `interfaces` and `virtual_walls`.
//! - [`accuracy`]: Field `accuracy`.
//! - [`schema`]: The JSON Schema of experiment files.
//! - [`sweep`]: Lists of values make a product of runs.

pub mod accuracy;
pub mod fields;
pub mod hemisphere;
pub mod interfaces;
pub mod machine;
pub mod refine;
pub mod schema;
pub mod source_split;
pub mod sweep;
