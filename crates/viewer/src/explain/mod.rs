//! Why a run took as long as it did, computed from its recording.

/// A recorded run with what was computed from it.
mod analysed_run;
/// Answers in words to the first questions about a run.
mod answers;
/// The critical path.
mod critical_path;
/// Numbers as text.
mod format;
/// The gap to a perfect speed-up, as a product of factors.
mod loss;
/// Where the time of each node went.
mod time_breakdown;

pub(crate) use analysed_run::AnalysedRun;
pub(crate) use answers::answers;
pub(crate) use critical_path::PathSegment;
pub(crate) use loss::loss_table;
