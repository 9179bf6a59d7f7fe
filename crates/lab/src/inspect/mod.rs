//! Looks at single files, scenes and runs, without a folder of results.
//!
//! - [`check`]: What a file is, and whether it is valid.
//! - [`stage`]: A scene with its light, to be drawn.
//! - [`trials`]: Single runs of an experiment.

pub mod check;
pub mod stage;
pub mod trials;
