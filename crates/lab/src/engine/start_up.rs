//! What a run tells of its start-up, where that is modelled.

use serde::{Deserialize, Serialize};
use virtwall::StartUpReport;

/// The columns of runs.csv: [`StartUpFigures`] by name.
pub const COLUMNS: [&str; 3] = ["start_up_s", "reading_s", "disk_wait_s"];

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

    /// The cell of a column.
    pub fn cell(&self, column: &str) -> Option<String> {
        let seconds = match column {
            "start_up_s" => self.start_up_s,
            "reading_s" => self.reading_s,
            "disk_wait_s" => self.disk_wait_s,
            _ => return None,
        };
        Some(format!("{seconds:.6}"))
    }
}
