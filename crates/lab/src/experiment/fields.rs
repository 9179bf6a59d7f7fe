//! The fields of an experiment file, as Rust types. An [`Experiment`] is one point of a sweep.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use virtwall::{Mapping, Order, Selection, Ties};

use crate::experiment::accuracy::AccuracyFields;
use crate::experiment::hemisphere::Hemisphere;
use crate::experiment::interfaces::{Interfaces, VirtualWalls};
use crate::experiment::machine::MachineChoice;
use crate::experiment::plot::Plot;
use crate::experiment::refine::RefineFields;
use crate::experiment::source_split::SplitFields;
use crate::files::WrongField;
use crate::files::counts::Triple;
use crate::files::quantity::{Fraction, Length, Period};

/// Fields of an experiment file in which a list does not make a sweep.
pub const UNSWEPT: [&str; 5] = ["$schema", "title", "speed_up_over", "compare_with", "plots"];

/// Takes out of a point what its results are compared with, and plots: its light needs none of it.
pub fn leave_out_comparisons(point: &mut Value) {
    let Some(fields) = point.as_object_mut() else { return };
    for field in ["compare_with", "reference", "error_causes", "plots"] {
        fields.shift_remove(field);
    }
    fields.get_mut("accuracy").and_then(|of| of.as_object_mut()?.shift_remove("sweep"));
}

/// An experiment: the runs of a scene on a machine, and what to draw of them.
///
/// One rule makes every sweep: where one value is expected, a list of values sweeps it. The runs
/// are the product of all lists, the first list in the file slowest, and each swept field is a
/// column of runs.csv. Only in "plots" a list is a plain list.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Virtwall experiment")]
pub struct Experiment {
    /// Path of this schema, for editors.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// What the experiment shows, for people.
    pub title: String,
    /// The scene: the name of a file in scenes/, or a path, relative to this file, to a scene
    /// description (.json) or a bare OBJ file (.obj).
    pub scene: String,
    /// The machine: the name of a file in machines/, or a path, relative to this file. Or an object:
    /// such a name under "extends", "paragon-xps" by default, and fields of a machine file in place of
    /// that machine's; a bare value does where the file says value, provenance and source. A model of
    /// the network that is chosen here brings the columns network_used, network_why, busiest_link and
    /// blocked_s. A machine with memory, with a display or with a start-up brings columns of its own.
    #[serde(default)]
    pub machine: MachineChoice,
    /// How far the time on the network "auto" may be from that on the next finer one. Default: 1 %.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub network_tolerance: Option<Fraction>,
    /// Whether time_s begins with the start-up, in place of the end of initialisation; the machine's file
    /// must model it. Results on such a machine have the columns start_up_s, reading_s and disk_wait_s.
    /// Paper: §4.2.1.
    #[serde(default, skip_serializing_if = "is_default")]
    pub count_start_up: bool,
    /// Compute nodes used, at most as many as there are local environments. Paper: Table 1.
    #[schemars(range(min = 1))]
    pub processors: u32,
    /// Local environments that the scene is cut into. Paper: 56 (§5.3).
    #[serde(default = "default_local_environments")]
    #[schemars(range(min = 1))]
    pub local_environments: u32,
    /// Local environments along x, y and z, such as "14x4x1"; they make "local_environments" in
    /// all. Default: the scene file's cut for that number, else the one whose environments are
    /// nearest to cubes. Choice C2: the paper's cut is "straightforward and automatic" (§4.2.1).
    #[serde(default)]
    pub cut: Option<Triple>,
    /// Cells of the whole scene along x, y and z, such as "56x28x14". Cut planes lie between
    /// cells. Default: the scene file's, else about one cell a polygon. Choice C10: the paper
    /// tells no number, only that it is the same for every cut (§5.2).
    #[serde(default)]
    pub cells: Option<Triple>,
    /// Longest edge of a patch, such as "0.30 m". Default: the scene file's, else a fiftieth of
    /// the scene's diagonal.
    #[serde(default)]
    pub patch_size: Option<Length>,
    /// Longest edge of a patch that emits light. Default: the scene file's, else as
    /// "patch_size". Choice C11: how finely the paper's lights are meshed is unpublished; it
    /// decides how many shots there are.
    #[serde(default)]
    pub emitter_patch_size: Option<Length>,
    /// Smaller patches where radiosity changes.
    #[serde(default, skip_serializing_if = "RefineFields::is_none")]
    pub refine: RefineFields,
    /// The hemisphere of rays over a source.
    #[serde(default)]
    pub hemisphere: Hemisphere,
    /// What carries light across from one local environment to the next.
    #[serde(default, skip_serializing_if = "is_default")]
    pub interfaces: Interfaces,
    /// How virtual walls are meshed, where they stand in place of masks.
    #[serde(default, skip_serializing_if = "is_default")]
    pub virtual_walls: VirtualWalls,
    /// Bits of an integer of a mask where the scene has media: 8 or 16, 16 by default. Choice C42: the paper
    /// has such masks in sight and says no more (§3.2).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 8, max = 16))]
    pub mask_bits: Option<u32>,
    /// Number of sources that a patch is cut into, where other polygons are near.
    #[serde(default, skip_serializing_if = "is_default")]
    pub source_split: SplitFields,
    /// Over-shooting: energy that a patch without emission shoots, over its unshot energy, from 1 to less than
    /// 2. It shoots in advance what it is still to receive.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub overshoot: f64,
    /// Whether radiosities include the ambient term: an estimate of what the light that was not shot would add.
    /// It changes only their errors.
    #[serde(default, skip_serializing_if = "is_default")]
    pub ambient: bool,
    /// What radiosities are compared with: "dense", the dense solution of the run's own mesh; "stored",
    /// results/references/<scene>.json as `virtwall reference` stores it; the name of another one
    /// there, or a path. With it come the columns error_l2, error_max and reference_error, all
    /// relative to the root mean square of what is reflected.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reference: Option<String>,
    /// Whether to find the parts of each run's error, by additional runs: columns error_stopping,
    /// error_directions, error_sampling and error_mesh. It needs a "reference".
    #[serde(default, skip_serializing_if = "is_default")]
    pub error_causes: bool,
    /// The error that results are to stay below. Pilot runs find the cheapest setting for each scene; it is
    /// described in the columns from target_l2 on.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub accuracy: Option<AccuracyFields>,
    /// Which source a node shoots next. Choice C4: §3.2 says the most unshot energy, §4.2.2 the
    /// greatest delta-radiosity.
    #[serde(default)]
    pub selection: Selection,
    /// Which source goes first when a received and a local one are worth the same. Choice C5:
    /// the paper does not say.
    #[serde(default)]
    pub ties: Ties,
    /// Whether the next source is looked for in all environments of a processor (Figure 9), or in one after
    /// the other (§5.2). Choice C45: both are the paper's.
    #[serde(default, skip_serializing_if = "is_default")]
    pub order: Order,
    /// When sources are no longer shot.
    #[serde(default)]
    pub stop: Stop,
    /// Whether a mask that arrives while another one of the same source waits for the same local
    /// environment is merged with it. Choice C9: the paper puts all sources that arrive into the
    /// queue, and says no more.
    #[serde(default)]
    pub merge_masks: bool,
    /// How local environments are given to processors. Choice C3: the paper says automatic,
    /// without load balancing (§4.2.1).
    #[serde(default)]
    pub mapping: Mapping,
    /// Whether compute nodes send radiosity updates to the service node. Paper: Figure 6.
    #[serde(default = "yes")]
    pub radiosity_updates: bool,
    /// Whether runs reuse the shots of others. It changes no result, only host times: set it to false to
    /// measure them.
    #[serde(default = "yes", skip_serializing_if = "is_true")]
    pub reuse_shots: bool,
    /// Seed of every random choice.
    #[serde(default = "default_seed")]
    pub seed: u64,
    /// Processors of the run that speed-ups are relative to, 1 by default. The published speed-ups are over one
    /// processor: with another number they are left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1))]
    pub speed_up_over: Option<u32>,
    /// A CSV file, relative to this one, with the columns scene, processors, time_s and speed_up:
    /// published figures to compare ours with.
    #[serde(default)]
    pub compare_with: Option<String>,
    /// What to draw. Lists are plain lists here, they sweep nothing.
    #[serde(default)]
    pub plots: Vec<Plot>,
}

impl Experiment {
    /// A scene by itself: one processor, one local environment, all else by default.
    pub fn of_one_environment(scene: &str) -> Experiment {
        let fields = json!({
            "title": "", "scene": scene, "processors": 1, "local_environments": 1,
        });
        serde_json::from_value(fields).expect("all fields that have no default are there")
    }
}

/// When sources are no longer shot.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Stop {
    /// A local patch is never selected under this share of what the brightest patch begins with.
    /// Choice C6: the paper's threshold is unpublished.
    pub patch_threshold: Fraction,
    /// The service node ends selection when unshot energy and energy in transit fall to this
    /// share of the emitted energy. Choice C7: unpublished.
    pub energy_threshold: Fraction,
    /// How often the service node collects the energy left. Choice C8: unpublished.
    pub collect_every: Period,
    /// The run fails when this number of shots of patches carried more than a tenth of the light that as many
    /// before them carried, or with over-shooting by w more than 0.1^(w (2 - w)): where processors with little to
    /// do shoot the least light that arrives while others fall behind, or where over-shooting diverges. Default: 10
    /// x processors x patches / (1 - the greatest reflectance, 0.9999 at most), times the sources that a patch is
    /// cut into; bins of virtual walls count as patches. On one processor light falls to 1/20,000 in as many, or further. Assumed: the 10.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1))]
    pub shots_without_progress: Option<std::num::NonZeroU32>,
}

/// Least threshold that a run reaches for certain, as a share: light fades far below it, down to the smallest
/// numbers there are, which reflection no longer makes smaller.
pub const LEAST_THRESHOLD: f64 = 1e-30;

impl Stop {
    /// Refuses thresholds under which a run would not end.
    pub fn check(&self) -> Result<(), WrongField> {
        let Stop { patch_threshold, energy_threshold, .. } = self;
        if patch_threshold.value().max(energy_threshold.value()) >= LEAST_THRESHOLD {
            return Ok(());
        }
        let message = format!(
            "{patch_threshold}, and \"energy_threshold\" {energy_threshold}: the run would not end; expected \
             1e-28 % or more for one of the two"
        );
        Err(("stop.patch_threshold", message))
    }
}

impl Default for Stop {
    fn default() -> Stop {
        Stop {
            patch_threshold: Fraction::parse("10 %").expect("10 % is a fraction"),
            energy_threshold: Fraction::parse("0 %").expect("0 % is a fraction"),
            collect_every: Period::parse("1 s").expect("1 s is a time"),
            shots_without_progress: None,
        }
    }
}

fn one() -> f64 {
    1.0
}

fn is_one(value: &f64) -> bool {
    *value == 1.0
}

fn default_local_environments() -> u32 {
    56
}

fn default_seed() -> u64 {
    1996
}

fn yes() -> bool {
    true
}

/// Leaves out a field that has its default.
pub fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

/// Leaves out a field that is true, its default.
fn is_true(value: &bool) -> bool {
    *value
}
