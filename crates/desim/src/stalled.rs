//! Deadlock report: no event is left and processes still wait.

use std::error::Error;
use std::fmt;

use crate::time::Time;

/// Deadlock report: no event is left and processes still wait, or a part of the simulation halted it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stalled {
    /// Time of the last event.
    pub at: Time,
    /// Why the run was halted; none if no event was left.
    pub cause: Option<String>,
    /// The processes that have not ended, in order of creation.
    pub waiting: Vec<Waiting>,
}

/// One process that waits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Waiting {
    /// Name of the process.
    pub process: String,
    /// Name of what it waits for.
    pub on: String,
}

impl fmt::Display for Stalled {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "stalled at {}: ", self.at)?;
        f.write_str(self.cause.as_deref().unwrap_or("no event is left"))?;
        for (index, Waiting { process, on }) in self.waiting.iter().enumerate() {
            let separator = if index == 0 { ", but" } else { ";" };
            write!(f, "{separator} {process} waits for {on}")?;
        }
        Ok(())
    }
}

impl Error for Stalled {}
