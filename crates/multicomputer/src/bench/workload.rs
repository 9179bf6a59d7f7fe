//! A file of messages, in any of the formats that are read.

use std::path::Path;

use config::Fault;

use super::schedule::Schedule;
use super::trace::Trace;
use crate::network::LinkParameters;

/// What a file of messages contains.
pub enum Workload {
    /// Messages with times, from a JSON list or a .csv file.
    Trace(Trace),
    /// What each node does, from a .goal file.
    Schedule(Schedule),
}

impl Workload {
    /// Whether a file's name says that it is one, in a format of its own.
    pub fn is_named(path: &Path) -> bool {
        [Some("goal"), Some("csv")].contains(&extension(path).as_deref())
    }

    /// Reads a file for a machine with this number of nodes and these links.
    ///
    /// # Errors
    /// [`Fault`], with file, line, what was found and what was expected.
    pub fn read(
        path: &Path,
        nodes: usize,
        links: Option<&LinkParameters>,
    ) -> Result<Workload, Fault> {
        let text = config::read_text(path)?;
        let file = path.display().to_string();
        match extension(path).as_deref() {
            Some("goal") => Schedule::from_goal(&text, &file, nodes).map(Workload::Schedule),
            Some("csv") => Trace::from_csv(&text, &file, nodes, links).map(Workload::Trace),
            _ => Trace::from_json(&text, &file, nodes).map(Workload::Trace),
        }
    }
}

fn extension(path: &Path) -> Option<String> {
    path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase())
}
