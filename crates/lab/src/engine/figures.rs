//! What one run found, as kept between a run and its row of results.

use serde::{Deserialize, Serialize};

use crate::engine::display::DisplayFigures;
use crate::engine::error_figures::ErrorFigures;
use crate::engine::message_layer::MessageLayerFigures;
use crate::engine::network::NetworkFigures;
use crate::engine::node_memory::NodeMemoryFigures;
use crate::engine::start_up::StartUpFigures;

/// The figures of one run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Figures {
    /// Virtual seconds until the last node knows of the end; none on real threads.
    pub time_s: Option<f64>,
    /// Patches that nodes shot from their own local environments.
    pub local_shots: u64,
    /// Sources with masks that nodes received and shot on.
    pub received_shots: u64,
    /// Messages with sources between compute nodes.
    pub messages: u64,
    /// Their bytes.
    pub message_bytes: u64,
    /// Radiosity updates to the service node.
    pub update_messages: u64,
    /// Their bytes.
    pub update_bytes: u64,
    /// Tokens, energy reports and other control messages.
    pub control_messages: u64,
    /// Share of their time that nodes compute, 0 to 1; none on real threads.
    pub busy_fraction: Option<f64>,
    /// |emitted − (absorbed + unshot + in transit + escaped + by media)| / emitted.
    pub energy_error: f64,
    /// Where the emitted energy is at the end.
    pub energy: Energy,
    /// Whether the end was announced too early (§4.2.4), and the share of the emitted energy
    /// lost by it.
    pub too_early: Option<f64>,
    /// Patches in all.
    pub patches: u64,
    /// Operations counted, by name.
    pub work: Vec<(String, u64)>,
    /// Seconds that processors waited for what their caches missed, all added; none without caches.
    #[serde(default)]
    pub missing_s: Option<f64>,
    /// Seconds that processors waited for translations of addresses, all added; none where all are known.
    #[serde(default)]
    pub translating_s: Option<f64>,
    /// Figures of the network, if they are asked for.
    #[serde(default)]
    pub network: Option<NetworkFigures>,
    /// Figures of the nodes' memory, where the machine models it.
    #[serde(default)]
    pub memory: Option<NodeMemoryFigures>,
    /// Errors of its radiosities, if there is an answer to compare with.
    #[serde(default)]
    pub errors: Option<ErrorFigures>,
    /// Figures of the message layer, where the machine models one.
    #[serde(default)]
    pub message_layer: Option<MessageLayerFigures>,
    /// Figures of the display, where the machine models one.
    #[serde(default)]
    pub display: Option<DisplayFigures>,
    /// Figures of the start-up, where the machine models it.
    #[serde(default)]
    pub start_up: Option<StartUpFigures>,
}

/// Where the energy is at the end of a run, in shares of the emitted energy, all colours together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Energy {
    /// Turned into heat by surfaces.
    pub absorbed: f64,
    /// Waiting on patches to be shot.
    pub unshot: f64,
    /// On its way between local environments.
    pub in_transit: f64,
    /// Out of the scene.
    pub escaped: f64,
    /// Absorbed by participating media.
    #[serde(default)]
    pub medium: f64,
}
