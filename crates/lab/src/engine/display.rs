//! What runs tell of the display.

use serde::{Deserialize, Serialize};
use virtwall::DisplayReport;

/// What a run tells of the display, where one is modelled.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DisplayFigures {
    /// Seconds from the end of the computation until the last update was shown.
    pub lag_s: f64,
    /// Updates that the display has taken.
    pub shown: u64,
    /// Updates that it never got.
    pub dropped: u64,
    /// Seconds that compute nodes waited for room at the service node, all added.
    pub waiting_s: f64,
    /// Share of its life in which the service node's processor was busy.
    pub service_busy: f64,
    /// Share of the time until all was shown in which frames were on the Ethernet.
    pub ethernet_busy: f64,
    /// The same of the display, which takes updates in.
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
