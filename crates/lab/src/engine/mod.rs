//! One run. The only folder that calls the simulator.

pub mod error_figures; // The error of a run, and its parts.
pub mod figures; // What one run found.
pub mod network; // The network model of a run.
pub mod simulator; // A run from its rules to its figures.
