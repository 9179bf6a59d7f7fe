//! What to run, and its outcome.

mod counts;
mod display_report;
mod outcome;
mod run;

pub use counts::Counts;
pub use display_report::DisplayReport;
pub use outcome::{Ending, NodeReport, Outcome};
pub use run::Run;
