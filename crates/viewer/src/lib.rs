//! The viewer of a report: packs recorded runs into an HTML page that shows the light, the machine and
//! the timeline at any instant of a run, and explains in words why the run took as long as it did.
//!
//! The page needs nothing but a browser. `assets/` holds its program, in plain JavaScript.

/// An observer that packs a run in parts while it is under way.
mod broadcast;
/// Why a run took as long as it did: time per node, critical path, answers in words.
mod explain;
/// Runs as blocks of data for the page.
mod pack;
/// The parts of an HTML page: of a report, and of a page that follows runs while they are under way.
mod page;
/// What is recorded of a run.
mod record;
#[cfg(test)]
mod tests;

pub use broadcast::{Broadcast, Subscriber};
pub use page::{LivePage, LiveRun, MARKUP, ReportParts, STYLE, program};
pub use record::{LightRecording, RecordedRun};
