//! Figures of the start-up, where the machine models it.

use serde::{Deserialize, Serialize};
use virtwall::StartUpReport;

/// Start-up of the compute node that is ready last, in seconds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StartUpFigures {
    /// Time until it was ready.
    pub start_up_s: f64,
    /// Part of `start_up_s` until it had read the scene.
    pub reading_s: f64,
    /// Part of `reading_s` in which it waited at I/O nodes for requests of other nodes.
    pub disk_wait_s: f64,
}

impl StartUpFigures {
    /// The figures of a report.
    pub fn of(report: &StartUpReport) -> StartUpFigures {
        StartUpFigures {
            start_up_s: report.time.as_seconds_f64(),
            reading_s: report.reading.as_seconds_f64(),
            disk_wait_s: report.disk_wait.as_seconds_f64(),
        }
    }
}
