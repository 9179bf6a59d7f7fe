//! One run. The only folder that calls the simulator.
//!
//! - [`simulator`]: A run from its rules to its figures.
//! - [`knobs`]: How patches are shot.
//! - [`network`]: The network model of a run.
//! - [`figures`]: What one run found.
//! - [`error_figures`]: The error of a run, and its parts.

pub mod error_figures;
pub mod figures;
pub mod knobs;
pub mod network;
pub mod simulator;
