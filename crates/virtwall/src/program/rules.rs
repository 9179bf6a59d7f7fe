//! The rules of a run: settings that RR-3008 leaves open in its programs.

use desim::Duration;
use radiosity::{Emitter, Rgb};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::problem::{Mapping, Shooting};

/// Rules that every compute node follows.
#[derive(Clone, Debug, PartialEq)]
pub struct Rules {
    /// What makes a source the best.
    pub selection: Selection,
    /// Who goes first of equals.
    pub ties: Ties,
    /// Where a processor looks for its next source.
    pub order: Order,
    /// A local patch is not selected when its value is below this fraction of the greatest first
    /// value of any patch.
    ///
    /// Choice C6: "if its energy is under a given threshold" (§4.2.4); its value is not published.
    pub patch_threshold: f64,
    /// A wall patch hands nothing on below this fraction of the same value, where virtual walls stand in
    /// place of masks.
    ///
    /// Choice C41: the energy of a wall patch waits there, for more to come, while its processor has a better
    /// source than the brightest bin.
    pub wall_threshold: f64,
    /// The service node stops all selection when unshot energy and energy in transit together fall
    /// below this fraction of the emitted energy.
    ///
    /// Choice C7: the other reading of the same sentence.
    pub energy_threshold: f64,
    /// How often the service node collects these sums.
    ///
    /// Choice C8: "on a regular basis" (§4.2.4).
    pub collect_every: Duration,
    /// The run ends with an error when this number of shots of patches carried more than a tenth of the power
    /// that as many before them carried, or a larger part with over-shooting. Default: ten times as many as make light fall to 1/e on one processor,
    /// for each processor.
    pub shots_without_progress: Option<u64>,
    /// Whether radiosity updates are sent to the service node after every shot (Figure 6).
    pub radiosity_updates: bool,
    /// Whether a mask that arrives while another of the same source waits for the same environment
    /// is merged with it.
    ///
    /// Choice C9: RR-3008 puts all sources that arrived into the queue, and says no more.
    pub merge_masks: bool,
    /// Which processor gets which environments.
    pub mapping: Mapping,
    /// Seed of a random mapping.
    pub seed: u64,
    /// How a patch is shot.
    pub shooting: Shooting,
}

/// What makes a source the best.
///
/// Choice C4: §3.2 says "most unshot energy", §4.2.2 "greater delta-radiosity".
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Selection {
    /// Unshot power, W.
    #[default]
    Energy,
    /// Unshot radiosity, W/m².
    DeltaRadiosity,
}

impl Selection {
    /// The value by which sources are compared: the sum of the three colours, which is negative only
    /// where a patch was over-shot, and then counts as much.
    pub fn value(self, source: &Emitter) -> f64 {
        self.value_of(source.power, source.radiosity)
    }

    /// The same for a patch that was not selected yet.
    pub fn value_of(self, power: Rgb, radiosity: Rgb) -> f64 {
        match self {
            Selection::Energy => power.abs().element_sum(),
            Selection::DeltaRadiosity => radiosity.abs().element_sum(),
        }
    }
}

/// Where a processor looks for its next source.
///
/// Choice C45: Figure 9 chooses among all that a processor has; §5.2's "sequential algorithm processes local
/// environments ones after the others", all sources that wait for one before the next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Order {
    /// In all its environments.
    #[default]
    Best,
    /// In one environment until nothing is left there to shoot, then in the next that has something.
    InTurn,
}

/// Who goes first when a received source and a local patch have the same value; among received ones
/// it is the first to arrive, among local ones the lowest number.
///
/// Choice C5: RR-3008 leaves it open; where all lights are equal it decides.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Ties {
    /// Received sources: queues stay short.
    #[default]
    ReceivedFirst,
    /// Local patches: neighbours get work early.
    LocalFirst,
}
