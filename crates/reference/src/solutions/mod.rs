//! Radiosities of a whole scene.

pub mod centres; // form factors from points of patches
mod conjugate_gradients; // the linear solver
pub mod dense; // exact form factors between all patches, solved to machine precision
pub mod patches; // the patches that a solution is for
pub mod paths; // light paths from the emitters
pub mod witnesses; // error of a solution, estimated by independent sets of light paths

pub use centres::Centres;
pub use dense::{Dense, Solution};
pub use patches::Patches;
pub use paths::{Paths, Problem, Received};
pub use witnesses::{Testimony, Witnesses};
