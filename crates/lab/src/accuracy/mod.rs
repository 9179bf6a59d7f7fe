//! Errors of runs, and the search for settings that reach an error.

pub mod answer; // References and dense solutions.
pub mod causes; // The parts of an error.
pub mod errors; // The error of a run.
pub mod family; // All settings on one mesh, predicted from pilot runs.
pub mod pilot; // Pilot runs.
pub mod tuned; // A setting that was found.
pub mod tuner; // The search for the cheapest setting.
