//! From an experiment file to all its runs, every check included.

pub mod machines; // The machines of a sweep.
pub mod plan; // All runs of an experiment.
pub mod planner; // From a sweep to its plan.
pub mod plots; // Whether plots name columns that exist.
pub mod preparing; // What planning may use of the host.
pub mod reading; // Experiment files as plans.
pub mod suits; // Whether a machine can do what an experiment asks.
