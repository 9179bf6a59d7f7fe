//! Comparison of solutions.
//!
//! - `stored`: the file format of a reference solution
//! - `difference`: the difference between two solutions on different meshes

mod difference;
mod stored;

pub use difference::{Difference, Overlaps};
pub use stored::{Method, Reference, Subject};
