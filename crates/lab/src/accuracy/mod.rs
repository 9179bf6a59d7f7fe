//! Errors of runs, and the search for settings that reach an error.
//!
//! - [`answer`]: References and dense solutions.
//! - [`errors`]: The error of a run.
//! - [`causes`]: The parts of an error.
//! - [`pilot`]: Pilot runs.
//! - [`family`]: All settings on one mesh, predicted from pilot runs.
//! - [`tuned`]: A setting that was found.
//! - [`tuner`]: The search for the cheapest setting.

pub mod answer;
pub mod causes;
pub mod errors;
pub mod family;
pub mod pilot;
pub mod tuned;
pub mod tuner;
