//! Input files: what every reader of a JSON file needs, whatever the file is about.
//!
//! - [`Document`]: a file as its user wrote it, with the arguments laid over it
//! - [`Fault`], [`Place`]: what is wrong with an input, and where
//! - [`json`]: strict JSON, and the line on which a value begins
//! - [`merge`], [`fill`]: files that extend others, and defaults
//! - [`read()`], [`schema`]: JSON values as Rust types, unknown fields refused
//! - [`Quantity`], [`Dimension`]: numbers with units, written as text

mod dimension;
mod document;
mod fault;
pub mod json;
mod merge;
mod place;
mod quantity;
mod read;
pub mod schema;

pub use dimension::{Dimension, parse};
pub use document::{Document, read_text, unreadable};
pub use fault::{Fault, unknown};
pub use merge::{fill, merge};
pub use place::{Place, Step};
pub use quantity::{Bandwidth, Bytes, Cycles, Frequency, Measure, Quantity, Time};
pub use read::{read, refuse_unknown_keys};
