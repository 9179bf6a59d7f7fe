//! An experiment file: its fields, and the product of its lists.
//!
//! - [`fields`]: The fields of an experiment file.
//! - [`hemisphere`]: Field `hemisphere`.
//! - [`refine`]: Field `refine`.
//! - [`source_split`]: Field `source_split`.
//! - [`interfaces`]: Fields `interfaces` and `virtual_walls`.
//! - [`accuracy`]: Field `accuracy`.
//! - [`display`]: Field `display`, and figures of the display.
//! - [`node_memory`]: Field `node_memory`, and figures of the memory.
//! - [`sweep`]: Lists of values make a product of runs.

pub mod accuracy;
pub mod display;
pub mod fields;
pub mod hemisphere;
pub mod interfaces;
pub mod node_memory;
pub mod refine;
pub mod source_split;
pub mod sweep;
