//! What one run found, as kept between a run and its row of results. Each figure is a column, which
//! `table::columns` describes. Figures of what a machine does not model are none.

use multicomputer::LayerAccount;
use serde::{Deserialize, Serialize};
use virtwall::{DisplayReport, Outcome, StartUpReport};

use crate::engine::error_figures::ErrorFigures;
use crate::engine::network::NetworkFigures;

/// The figures of one run. Those in shares of time and of energy are from 0 to 1.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Figures {
    /// Virtual seconds until the last node knows of the end; none on real threads.
    pub time_s: Option<f64>,
    pub local_shots: u64,
    pub received_shots: u64,
    pub messages: u64,
    pub message_bytes: u64,
    pub update_messages: u64,
    pub update_bytes: u64,
    pub control_messages: u64,
    /// None on real threads.
    pub busy_fraction: Option<f64>,
    /// |emitted − (absorbed + unshot + in transit + escaped + by media)| / emitted.
    pub energy_error: f64,
    pub energy: Energy,
    /// Whether the end was announced too early (§4.2.4), and the share of the emitted energy
    /// lost by it.
    pub too_early: Option<f64>,
    pub patches: u64,
    /// Operations counted, by name.
    pub work: Vec<(String, u64)>,
    pub missing_s: Option<f64>,
    pub translating_s: Option<f64>,
    pub network: Option<NetworkFigures>,
    pub memory: Option<NodeMemoryFigures>,
    pub errors: Option<ErrorFigures>,
    pub message_layer: Option<MessageLayerFigures>,
    pub display: Option<DisplayFigures>,
    pub start_up: Option<StartUpFigures>,
}

/// Where the energy is at the end of a run, in shares of the emitted energy, all colours together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Energy {
    pub absorbed: f64,
    pub unshot: f64,
    pub in_transit: f64,
    pub escaped: f64,
    pub medium: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct NodeMemoryFigures {
    pub high_water: u64,
    pub paging_s: f64,
}

impl NodeMemoryFigures {
    pub fn of(outcome: &Outcome) -> Option<NodeMemoryFigures> {
        let high_water = outcome.nodes.iter().filter_map(|node| node.memory_high_water).max()?;
        let paging: desim::Duration = outcome.nodes.iter().map(|node| node.paging).sum();
        Some(NodeMemoryFigures { high_water, paging_s: paging.as_seconds_f64() })
    }
}

/// What the message layer did on all compute nodes, in addition to overheads.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MessageLayerFigures {
    pub packing_s: f64,
    pub copying_s: f64,
    pub waiting_for_room_s: f64,
    pub coprocessor_s: f64,
    pub unposted_messages: u64,
    pub held_messages: u64,
    pub buffer_bytes_most: u64,
}

impl MessageLayerFigures {
    pub fn of(account: &LayerAccount) -> MessageLayerFigures {
        MessageLayerFigures {
            packing_s: account.packing.as_seconds_f64(),
            copying_s: account.copying.as_seconds_f64(),
            waiting_for_room_s: account.waiting_for_room.as_seconds_f64(),
            coprocessor_s: account.coprocessor.as_seconds_f64(),
            unposted_messages: account.unposted_messages,
            held_messages: account.held_messages,
            buffer_bytes_most: account.buffer_bytes_most,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DisplayFigures {
    pub lag_s: f64,
    pub shown: u64,
    pub dropped: u64,
    pub waiting_s: f64,
    pub service_busy: f64,
    pub ethernet_busy: f64,
    pub display_busy: f64,
}

impl DisplayFigures {
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

/// Start-up of the compute node that is ready last.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StartUpFigures {
    pub start_up_s: f64,
    pub reading_s: f64,
    pub disk_wait_s: f64,
}

impl StartUpFigures {
    pub fn of(report: &StartUpReport) -> StartUpFigures {
        StartUpFigures {
            start_up_s: report.time.as_seconds_f64(),
            reading_s: report.reading.as_seconds_f64(),
            disk_wait_s: report.disk_wait.as_seconds_f64(),
        }
    }
}
