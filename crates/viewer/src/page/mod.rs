//! The viewer as parts of an HTML page.

mod assets; // the viewer's markup, style sheet and program
mod live; // the page that follows runs while they are under way
mod report; // the viewer's parts of a report

pub use assets::{MARKUP, STYLE, program};
pub use live::{LivePage, LiveRun};
pub use report::ReportParts;
