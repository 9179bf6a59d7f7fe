//! What is to be run, and what came out of it.

mod counts;
mod display_report;
mod outcome;
mod run;

pub use counts::Counts;
pub use display_report::DisplayReport;
pub use outcome::{Ending, NodeReport, Outcome};
pub use run::Run;
