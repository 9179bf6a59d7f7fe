//! The display: what an experiment changes of a machine's, and what runs tell of it.

use multicomputer::{Display, WhenFull};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use virtwall::DisplayReport;

use crate::files::quantity::{Period, Rate, Size};

/// What an experiment says of the display in place of the machine's file.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct DisplayFields {
    /// What happens to updates for which the service node has no room.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub when_full: Option<WhenFull>,
    /// That room.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub service_buffers: Option<Size>,
    /// Time of the service node's processor for a frame.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frame_time: Option<Period>,
    /// Bytes a second at which it puts updates into frames.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub copy_bandwidth: Option<Rate>,
    /// Bytes a second on the wire.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ethernet_bandwidth: Option<Rate>,
    /// Time in which the display takes an update in.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub update_time: Option<Period>,
}

impl DisplayFields {
    /// Whether the experiment leaves all as it is.
    pub fn is_empty(&self) -> bool {
        *self == DisplayFields::default()
    }

    /// Changes what the experiment names.
    pub fn lay_over(&self, display: &mut Display) {
        let time = |period: &Period| desim::Duration::from_seconds_f64(period.value());
        let bandwidth = |field: &Option<Rate>, value: &mut f64| {
            field.iter().for_each(|rate| *value = rate.value());
        };
        bandwidth(&self.copy_bandwidth, &mut display.copy_bandwidth);
        bandwidth(&self.ethernet_bandwidth, &mut display.ethernet.bandwidth);
        self.when_full.iter().for_each(|&when_full| display.when_full = when_full);
        self.frame_time.iter().for_each(|period| display.frame_time = time(period));
        self.update_time.iter().for_each(|period| display.update_time = time(period));
        let bytes = self.service_buffers.as_ref().map(|size| size.value().round() as u64);
        display.service_buffers = bytes.unwrap_or(display.service_buffers);
    }
}

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
