//! Figures of the display in a run's results.

use serde::{Deserialize, Serialize};
use virtwall::DisplayReport;

/// A run's figures of the display, if its machine has one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DisplayFigures {
    /// Seconds from the end of the computation until the last update was shown.
    pub lag_s: f64,
    /// Updates that the display showed.
    pub shown: u64,
    /// Updates that were dropped before they reached it.
    pub dropped: u64,
    /// Seconds that compute nodes waited for room at the service node, summed over all nodes.
    pub waiting_s: f64,
    /// Fraction of its life in which the service node's processor was busy.
    pub service_busy: f64,
    /// Fraction of the time until the last update was shown in which frames were on the Ethernet.
    pub ethernet_busy: f64,
    /// Fraction of that time in which the display was busy with updates.
    pub display_busy: f64,
}

impl DisplayFigures {
    /// The figures of a report.
    pub fn of(report: &DisplayReport) -> DisplayFigures {
        DisplayFigures {
            lag_s: report.lag.as_seconds_f64(),
            shown: report.shown,
            dropped: report.dropped,
            waiting_s: report.waiting.as_seconds_f64(),
            service_busy: report.service_busy,
            ethernet_busy: report.ethernet_busy,
            display_busy: report.consumer_busy,
        }
    }
}
