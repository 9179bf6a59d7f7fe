//! One run. The only folder that calls the simulator.
//!
//! - [`simulator`]: A run from its rules to its figures.
//! - [`network`]: The network model of a run.
//! - [`figures`]: What one run found.
//! - [`error_figures`]: The error of a run, and its parts.

pub mod error_figures;
pub mod figures;
pub mod network;
pub mod simulator;
