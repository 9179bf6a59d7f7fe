//! The viewer of a report: packs recorded runs into an HTML page that shows the light, the machine and
//! the timeline at any instant of a run, and explains in words why the run took as long as it did.
//!
//! The page needs nothing but a browser. `assets/` holds its program, in plain JavaScript.

mod broadcast; // an observer that packs a run in parts while it is under way
mod explain; // why a run took as long as it did: time per node, critical path, answers in words
mod pack; // runs as blocks of data for the page
mod page; // the parts of an HTML page: of a report, and of a page that follows runs under way
mod record; // what is recorded of a run
#[cfg(test)]
mod tests;

pub use broadcast::{Broadcast, Subscriber};
pub use page::{LivePage, LiveRun, MARKUP, ReportParts, STYLE, program};
pub use record::{LightRecording, RecordedRun};
