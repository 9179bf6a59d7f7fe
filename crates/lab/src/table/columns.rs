//! The columns of runs.csv: which there are, and what each holds.

use serde_json::Value;

use crate::accuracy::errors;
use crate::accuracy::tuned;
use crate::engine::error_causes;
use crate::engine::figures::Figures;
use crate::engine::message_layer;
use crate::engine::simulator;
use crate::engine::start_up;
use crate::experiment::display;
use crate::experiment::refine;
use crate::experiment::sweep::Axis;

/// Two of the first columns, against whose ones runs are held.
pub const PROCESSORS: &str = "processors";
pub const ENVIRONMENTS: &str = "local_environments";

/// The first columns, always these, in this order.
const FIRST: [&str; 14] = [
    "scene",
    PROCESSORS,
    ENVIRONMENTS,
    "seed",
    "time_s",
    "speed_up",
    "paper_time_s",
    "paper_speed_up",
    "local_shots",
    "received_shots",
    "messages",
    "message_bytes",
    "busy_fraction",
    "energy_error",
];

/// The columns after those of the swept fields.
const LAST: [&str; 13] = [
    "efficiency",
    "update_messages",
    "update_bytes",
    "control_messages",
    "ending",
    "energy_lost",
    "patches",
    "absorbed",
    "unshot",
    "in_transit",
    "escaped",
    "operations",
    "failure",
];

/// What the names of the host's columns begin with. They are no columns of runs.csv: they come from
/// host-times.json.
pub const HOST: &str = "host.";

/// What the host took for a run, as host-times.json names it.
pub const HOST_TIMES: [&str; 3] = ["cpu_s", "set_up_s", "clock_s"];

/// The column of operations, and what the name of a single count in it begins with.
pub const OPERATIONS: [&str; 2] = ["operations", "operations."];

/// All columns that can be drawn: those of a sweep, each count of operations, the host's.
pub fn drawable(axes: &[Axis], also: Also) -> Vec<String> {
    let counts = simulator::operations().map(|count| OPERATIONS[1].to_owned() + count);
    let host = HOST_TIMES.iter().map(|time| HOST.to_owned() + time);
    names(axes, also).into_iter().chain(counts).chain(host).collect()
}

/// The columns after these, where results tell of the network.
const OF_THE_NETWORK: [&str; 5] =
    ["network_used", "network_why", "difference_from_finest", "busiest_link", "blocked_s"];

/// The columns after these, where nodes have memory.
const OF_MEMORY: [&str; 2] = ["memory_high_water", "paging_s"];

/// The column after these, where scenes have participating media.
const OF_MEDIA: [&str; 1] = ["absorbed_by_media"];
/// The columns after these, where processors have caches: what they cost, and Figure 11's gain.
const OF_CACHES: [&str; 2] = ["missing_s", "gain"];
/// The column after these, where processors look for translations of addresses.
const OF_TRANSLATIONS: [&str; 1] = ["translating_s"];

/// What columns there are besides those of every sweep.
#[derive(Clone, Copy, Debug)]
pub struct Also {
    /// Those of the network.
    pub network: bool,
    /// Those of the nodes' memory.
    pub memory: bool,
    /// Those of the message layer.
    pub message_layer: bool,
    /// Those of settings that were found.
    pub accuracy: bool,
    /// That of participating media.
    pub media: bool,
    /// Those of refined meshes.
    pub refine: bool,
    /// Those of the processors' caches.
    pub caches: bool,
    /// That of translations of addresses.
    pub translations: bool,
    /// Those of errors.
    pub errors: bool,
    /// Those of what makes the errors up.
    pub causes: bool,
    /// Those of the display.
    pub display: bool,
    /// Those of the start-up.
    pub start_up: bool,
}

impl Also {
    fn columns(self) -> impl Iterator<Item = &'static str> {
        let network = OF_THE_NETWORK.into_iter().filter(move |_| self.network);
        let memory = OF_MEMORY.into_iter().filter(move |_| self.memory);
        let layer = message_layer::COLUMNS.into_iter().filter(move |_| self.message_layer);
        let media = OF_MEDIA.into_iter().filter(move |_| self.media);
        let caches = OF_CACHES.into_iter().filter(move |_| self.caches);
        let translations = OF_TRANSLATIONS.into_iter().filter(move |_| self.translations);
        let caches = caches.chain(translations);
        let refine = refine::COLUMNS.into_iter().filter(move |_| self.refine);
        let errors = errors::COLUMNS.into_iter().filter(move |_| self.errors);
        let display = display::COLUMNS.into_iter().filter(move |_| self.display);
        let start_up = start_up::COLUMNS.into_iter().filter(move |_| self.start_up);
        let machine = network.chain(memory).chain(layer).chain(display).chain(start_up);
        let causes = error_causes::COLUMNS.into_iter().filter(move |_| self.causes);
        let accuracy = tuned::COLUMNS.into_iter().filter(move |_| self.accuracy);
        machine.chain(caches).chain(media).chain(refine).chain(errors).chain(causes).chain(accuracy)
    }
}

/// All columns of a sweep, in order: the first ones, swept fields not among them, the last ones, and
/// those that are asked for.
pub fn names(axes: &[Axis], also: Also) -> Vec<String> {
    let swept = axes.iter().map(|axis| axis.place.to_string());
    let swept = swept.filter(|name| !FIRST.contains(&name.as_str()));
    let first = FIRST.iter().map(|&name| name.to_owned());
    let last = LAST.into_iter().chain(also.columns()).map(str::to_owned);
    first.chain(swept).chain(last).collect()
}

/// What a figure's column holds; `None` if the column is no figure of a run by itself.
pub fn figure(figures: &Figures, column: &str) -> Option<String> {
    let energy = &figures.energy;
    let network = figures.network.as_ref();
    let memory = figures.memory.as_ref();
    Some(match column {
        "network_used" => network.map_or(String::new(), |network| network.rung.clone()),
        "network_why" => network.map_or(String::new(), |network| network.why.clone()),
        "busiest_link" => optional(network.and_then(|network| network.busiest_link), 6),
        "blocked_s" => optional(network.map(|network| network.blocked_s), 9),
        "memory_high_water" => memory.map_or(String::new(), |memory| memory.high_water.to_string()),
        "paging_s" => optional(memory.map(|memory| memory.paging_s), 6),
        "missing_s" => optional(figures.missing_s, 6),
        "translating_s" => optional(figures.translating_s, 6),
        "time_s" => optional(figures.time_s, 6),
        "local_shots" => figures.local_shots.to_string(),
        "received_shots" => figures.received_shots.to_string(),
        "messages" => figures.messages.to_string(),
        "message_bytes" => figures.message_bytes.to_string(),
        "busy_fraction" => optional(figures.busy_fraction, 6),
        "energy_error" => format!("{:e}", figures.energy_error),
        "update_messages" => figures.update_messages.to_string(),
        "update_bytes" => figures.update_bytes.to_string(),
        "control_messages" => figures.control_messages.to_string(),
        "ending" => figures.too_early.map_or("agreed", |_| "too_early").to_owned(),
        "energy_lost" => format!("{:e}", figures.too_early.unwrap_or(0.0)),
        "patches" => figures.patches.to_string(),
        "absorbed" => format!("{:.9}", energy.absorbed),
        "unshot" => format!("{:.9}", energy.unshot),
        "in_transit" => format!("{:.9}", energy.in_transit),
        "absorbed_by_media" => format!("{:.9}", energy.medium),
        "escaped" => format!("{:.9}", energy.escaped),
        "operations" => {
            let counts = figures.work.iter().map(|(name, count)| format!("{name}={count}"));
            counts.collect::<Vec<_>>().join(" ")
        }
        _ => {
            let layer = figures.message_layer.and_then(|layer| layer.cell(column));
            let display = || figures.display.and_then(|display| display.cell(column));
            let start_up = || figures.start_up.and_then(|start_up| start_up.cell(column));
            let errors = || figures.errors.and_then(|errors| errors.cell(column));
            return layer.or_else(display).or_else(start_up).or_else(errors);
        }
    })
}

/// A swept value as a cell.
pub fn cell(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}

fn optional(value: Option<f64>, decimals: usize) -> String {
    value.map_or(String::new(), |value| format!("{value:.decimals$}"))
}
