//! Comparison of solutions.

mod difference; // the difference between two solutions on different meshes
mod stored; // the file format of a reference solution

pub use difference::{Difference, Overlaps};
pub use stored::{Method, NoReference, Reference, Subject};
