//! Why a run took as long as it did, computed from its recording.

mod analysed_run; // a recorded run with what was computed from it
mod answers; // answers in words to the first questions about a run
mod critical_path; // the critical path
mod format; // numbers as text
mod loss; // the gap to a perfect speed-up, as a product of factors
mod time_breakdown; // where the time of each node went

pub(crate) use analysed_run::AnalysedRun;
pub(crate) use answers::answers;
pub(crate) use critical_path::PathSegment;
pub(crate) use loss::loss_table;
