//! Input files: what every reader of a JSON file needs, whatever the file is about.

mod dimension; // units of physical dimensions
mod document; // a file as its user wrote it, with the arguments laid over it
mod fault; // what is wrong with an input
mod file; // files that users name, and pipes
pub mod json; // strict JSON, and the line on which a value begins
mod merge; // files that extend others, and defaults
mod place; // where in a file
mod quantity; // numbers with units, written as text
mod read; // JSON values as Rust types, unknown fields refused
mod readable; // names and numbers in messages, short ones
pub mod schema; // schemas of these types

pub use dimension::{Dimension, parse};
pub use document::Document;
pub use fault::{Fault, distance, unknown};
pub use file::{read_bytes, read_text, unreadable};
pub use merge::{fill, merge};
pub use place::{Place, Step};
pub use quantity::{Bandwidth, Bytes, Cycles, Frequency, Measure, Quantity, Time};
pub use read::{read, refuse_unknown_keys};
pub use readable::{decimal, short_name, shortened};
