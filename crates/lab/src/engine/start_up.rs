//! What a run tells of its start-up, where that is modelled.

use serde::{Deserialize, Serialize};
use virtwall::StartUpReport;

/// How the last compute node to be ready came to be so, in seconds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StartUpFigures {
    /// Until it was ready.
    pub start_up_s: f64,
    /// Of that, until it had read the scene.
    pub reading_s: f64,
    /// Of that, its waiting for requests of others at I/O nodes.
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
