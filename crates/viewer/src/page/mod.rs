//! The viewer as parts of an HTML page.

/// The viewer's markup, style sheet and program.
mod assets;
/// The page that follows runs while they are under way.
mod live;
/// The viewer's parts of a report.
mod report;

pub use assets::{MARKUP, STYLE, program};
pub use live::{LivePage, LiveRun};
pub use report::ReportParts;
