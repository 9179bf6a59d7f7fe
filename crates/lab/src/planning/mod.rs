//! From an experiment file to all its runs, every check included.
//!
//! - [`preparing`]: What planning may use of the host.
//! - [`plan`]: All runs of an experiment.
//! - [`suits`]: Whether a machine can do what an experiment asks.
//! - [`plots`]: Whether plots name columns that exist.
//! - [`machines`]: The machines of a sweep.
//! - [`planner`]: From an experiment file to its plan.

pub mod machines;
pub mod plan;
pub mod planner;
pub mod plots;
pub mod preparing;
pub mod suits;
