//! Reference answers: what form factors and radiosities should be, each with its error.
//!
//! This crate knows nothing of processors, messages, time or files.

mod comparison; // stored solutions, and the difference between two solutions
mod form_factors; // closed forms, exact quadrature between polygons and objects, and rays
mod solutions; // radiosities of a scene, by a dense system or by light paths

pub use comparison::{Difference, Method, NoReference, Overlaps, Reference, Subject};
pub use form_factors::{
    Estimate, ObjectRays, Objects, Pair, Surface, Tolerance, closed_form, element_to_polygon,
};
pub use solutions::{
    Centres, Dense, Patches, Paths, Problem, Received, Solution, Testimony, Witnesses,
};
