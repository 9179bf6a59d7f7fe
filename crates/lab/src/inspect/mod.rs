//! Looks at single files, scenes and runs, without a folder of results.

pub mod check; // What a file is, and whether it is valid.
pub mod kind; // Which kind of file a file is.
pub mod outline; // What an experiment does.
pub mod stage; // A scene with its light, to be drawn.
pub mod trials; // Single runs of an experiment.
