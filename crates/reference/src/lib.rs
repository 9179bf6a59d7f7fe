//! What the answer should be: closed-form view factors, form factors as exact as wanted, and two
//! solutions to hold others against, a dense one and a path-traced one.
//!
//! Knows nothing of processors, messages or time, nor of files.

mod centres;
pub mod closed_form;
mod conjugate;
mod cubature;
mod dense;
mod difference;
mod element;
mod gauss;
mod objects;
mod pair;
mod patches;
mod paths;
mod rays;
mod ring;
mod sampling;
mod stored;
mod witnesses;

pub use centres::Centres;
pub use cubature::{Estimate, Tolerance};
pub use dense::{Dense, Solution};
pub use difference::{Difference, Overlaps};
pub use element::element_to_polygon;
pub use objects::Objects;
pub use pair::{Pair, Surface};
pub use patches::Patches;
pub use paths::{Paths, Problem, Received};
pub use rays::ObjectRays;
pub use stored::{Method, Reference, Subject};
pub use witnesses::{Testimony, Witnesses};
