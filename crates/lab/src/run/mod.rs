//! Carries out the runs of a plan on worker threads.

pub mod claim; // A folder of results, for one process at a time.
pub mod estimate; // How long the rest of a sweep takes the host.
pub mod event_log; // Events as text.
pub mod feed; // Updates of a run for live viewers.
pub mod progress; // Progress counters of a run.
pub mod queue; // Which run is next.
pub mod runner; // Worker threads that carry out a plan.
pub mod saved; // Finished runs of an interrupted sweep.
pub mod shot_files; // Kept shots in files.
pub mod shot_sum; // What a run has done so far.
pub mod traces; // Trace files of runs.
pub mod viewing; // Which runs the report shows.
