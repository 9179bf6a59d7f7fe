//! Radiosities of a whole scene.
//!
//! - `patches`: the patches that a solution is for
//! - `conjugate_gradients`: the linear solver
//! - `dense`: exact form factors between all patches, solved to machine precision
//! - `centres`: form factors from points of patches
//! - `paths`: light paths from the emitters
//! - `witnesses`: error of a solution, estimated by independent sets of light paths

pub mod centres;
mod conjugate_gradients;
pub mod dense;
pub mod patches;
pub mod paths;
pub mod witnesses;

pub use centres::Centres;
pub use dense::{Dense, Solution};
pub use patches::Patches;
pub use paths::{Paths, Problem, Received};
pub use witnesses::{Testimony, Witnesses};
