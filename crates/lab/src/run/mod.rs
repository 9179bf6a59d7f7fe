//! Carries out the runs of a plan on worker threads.
//!
//! - [`runner`]: Worker threads that carry out a plan.
//! - [`queue`]: Which run is next.
//! - [`progress`]: Progress counters of a run.
//! - [`feed`]: Updates of a run for live viewers.
//! - [`saved`]: Finished runs of an interrupted sweep.
//! - [`shot_files`]: Kept shots in files.
//! - [`traces`]: Trace files of runs.
//! - [`viewing`]: Which runs the report shows.

pub mod feed;
pub mod progress;
pub mod queue;
pub mod runner;
pub mod saved;
pub mod shot_files;
pub mod traces;
pub mod viewing;
