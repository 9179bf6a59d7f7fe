//! What to run, and its outcome.

mod counts;
mod display_report;
mod outcome;
mod run;
mod sequence;

pub use counts::Counts;
pub use display_report::DisplayReport;
pub use outcome::{Ending, NodeReport, Outcome};
pub use run::Run;
pub use sequence::most_shots_in_sequence;
pub(crate) use sequence::shots_to_fall;
