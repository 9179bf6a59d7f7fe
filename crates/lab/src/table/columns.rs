//! The columns of runs.csv. A new column is one entry of [`COLUMNS`].

use multicomputer::MessageLayer;
use radiosity::Refinement;
use serde_json::{Value, json};

use crate::engine::network;
use crate::engine::simulator;
use crate::experiment::sweep::Axis;
use crate::table::column::{Column, Input, Row};

/// The column after which the swept fields of the experiment stand.
const SWEPT_AFTER: &str = "energy_error";

pub const COLUMNS: &[Column] = &[
    column("scene", "Scene.", always, |r| text(&r.input.point.scene)),
    column("processors", "Compute nodes used.", always, |r| text(r.input.point.processors)),
    column("local_environments", "Local environments that the scene is cut into.", always, |r| {
        text(r.input.point.local_environments)
    }),
    column("seed", "Seed of all random choices.", always, |r| text(r.input.point.seed)),
    column("time_s", "Virtual time, s. Empty on threads.", always, |r| {
        fixed(r.figures?.time_s?, 6)
    }),
    column("speed_up", "Time on one processor, all else equal, over time_s.", always, |r| {
        fixed(r.speed_up?, 4)
    }),
    column("paper_time_s", "Published time, s.", always, |r| text(&r.published.time_s)),
    column("paper_speed_up", "Published speed-up.", always, |r| text(&r.published.speed_up)),
    column("local_shots", "Patches shot in their own local environments.", always, |r| {
        text(r.figures?.local_shots)
    }),
    column("received_shots", "Received sources shot.", always, |r| text(r.figures?.received_shots)),
    column("messages", "Sources sent from node to node.", always, |r| text(r.figures?.messages)),
    column("message_bytes", "Bytes of these messages.", always, |r| text(r.figures?.message_bytes)),
    column("busy_fraction", "Share of their time that nodes compute.", always, |r| {
        fixed(r.figures?.busy_fraction?, 6)
    }),
    column("energy_error", "Error of the energy balance, over the emitted energy.", always, |r| {
        text(format_args!("{:e}", r.figures?.energy_error))
    }),
    column("efficiency", "Speed-up over processors.", always, |r| {
        fixed(r.speed_up? / f64::from(r.input.point.processors), 4)
    }),
    column("update_messages", "Radiosity updates to the service node.", always, |r| {
        text(r.figures?.update_messages)
    }),
    column("update_bytes", "Bytes of these updates.", always, |r| text(r.figures?.update_bytes)),
    column("control_messages", "Tokens, energy reports and other control.", always, |r| {
        text(r.figures?.control_messages)
    }),
    column("ending", "How it ended: agreed, too_early or failed.", always, |r| match r.figures {
        Some(figures) => text(figures.too_early.map_or("agreed", |_| "too_early")),
        None => r.failure.map(|_| "failed".to_owned()),
    }),
    column("energy_lost", "Share of the emitted energy lost by ending too early.", always, |r| {
        text(format_args!("{:e}", r.figures?.too_early.unwrap_or(0.0)))
    }),
    column("patches", "Patches of the scene.", always, |r| text(r.figures?.patches)),
    column("absorbed", "Share of the emitted energy that surfaces absorbed.", always, |r| {
        fixed(r.figures?.energy.absorbed, 9)
    }),
    column("unshot", "Share of it that patches have not shot.", always, |r| {
        fixed(r.figures?.energy.unshot, 9)
    }),
    column("in_transit", "Share of it between local environments.", always, |r| {
        fixed(r.figures?.energy.in_transit, 9)
    }),
    column("escaped", "Share of it that left the scene.", always, |r| {
        fixed(r.figures?.energy.escaped, 9)
    }),
    column("operations", "Operations counted, by name.", always, |r| {
        let counts = r.figures?.work.iter().map(|(name, count)| format!("{name}={count}"));
        Some(counts.collect::<Vec<_>>().join(" "))
    }),
    column("failure", "Why the run failed.", always, |r| r.failure.map(str::to_owned)),
    column("network_used", "Network model used.", on_network, |r| text(&r.network()?.model)),
    column("network_why", "Why, if it was chosen automatically.", on_network, |r| {
        text(&r.network()?.why)
    }),
    column("difference_from_finest", "Time against the finest network's.", on_network, |r| {
        text(format_args!("{:.6} %", r.difference_from_finest? * 100.0))
    }),
    column("busiest_link", "Share of time that the busiest link is used.", on_network, |r| {
        fixed(r.network()?.busiest_link?, 6)
    }),
    column("blocked_s", "Time that messages delayed each other, summed, s.", on_network, |r| {
        fixed(r.network()?.blocked_s, 9)
    }),
    column("memory_high_water", "Most memory used on one node, bytes.", on_memory, |r| {
        text(r.figures?.memory?.high_water)
    }),
    column("paging_s", "Time that nodes waited for pages, summed, s.", on_memory, |r| {
        fixed(r.figures?.memory?.paging_s, 6)
    }),
    column("packing_s", "Time spent on making packets, summed, s.", on_message_layer, |r| {
        fixed(r.figures?.message_layer?.packing_s, 9)
    }),
    column("copying_s", "Time spent on copying unposted messages, s.", on_message_layer, |r| {
        fixed(r.figures?.message_layer?.copying_s, 9)
    }),
    column("waiting_for_room_s", "Time waiting for room in buffers, s.", on_message_layer, |r| {
        fixed(r.figures?.message_layer?.waiting_for_room_s, 9)
    }),
    column("coprocessor_s", "Busy time of message coprocessors, s.", on_message_layer, |r| {
        fixed(r.figures?.message_layer?.coprocessor_s, 9)
    }),
    column("unposted_messages", "Messages without a posted receive.", on_message_layer, |r| {
        text(r.figures?.message_layer?.unposted_messages)
    }),
    column("held_messages", "Messages that waited for room in buffers.", on_message_layer, |r| {
        text(r.figures?.message_layer?.held_messages)
    }),
    column("buffer_bytes_most", "Most bytes used of a node's buffers.", on_message_layer, |r| {
        text(r.figures?.message_layer?.buffer_bytes_most)
    }),
    column("display_lag_s", "Time from the end until all is shown, s.", on_display, |r| {
        fixed(r.figures?.display?.lag_s, 6)
    }),
    column("updates_shown", "Updates that the display has taken.", on_display, |r| {
        text(r.figures?.display?.shown)
    }),
    column("updates_dropped", "Updates that the display never got.", on_display, |r| {
        text(r.figures?.display?.dropped)
    }),
    column("waiting_for_display_s", "Time that nodes waited for it, s.", on_display, |r| {
        fixed(r.figures?.display?.waiting_s, 6)
    }),
    column("service_busy_fraction", "Share of time the service node works.", on_display, |r| {
        fixed(r.figures?.display?.service_busy, 6)
    }),
    column("ethernet_busy_fraction", "Share of time the Ethernet is used.", on_display, |r| {
        fixed(r.figures?.display?.ethernet_busy, 6)
    }),
    column("display_busy_fraction", "Share of time the display works.", on_display, |r| {
        fixed(r.figures?.display?.display_busy, 6)
    }),
    column("start_up_s", "Time until all nodes are ready, s.", on_start_up, |r| {
        fixed(r.figures?.start_up?.start_up_s, 6)
    }),
    column("reading_s", "Of that, until the last has read the scene, s.", on_start_up, |r| {
        fixed(r.figures?.start_up?.reading_s, 6)
    }),
    column("disk_wait_s", "Of that, its wait at I/O nodes, s.", on_start_up, |r| {
        fixed(r.figures?.start_up?.disk_wait_s, 6)
    }),
    column("missing_s", "Time spent on cache misses, summed, s.", on_caches, |r| {
        fixed(r.figures?.missing_s?, 6)
    }),
    column("gain", "Time with one local environment over time_s (Figure 11).", on_caches, |r| {
        fixed(r.gain?, 4)
    }),
    column("translating_s", "Time spent on address translation, s.", on_translations, |r| {
        fixed(r.figures?.translating_s?, 6)
    }),
    column("absorbed_by_media", "Share of the energy that media absorbed.", in_media, |r| {
        fixed(r.figures?.energy.medium, 9)
    }),
    column("pilot_rays", "Rays of the pilot run that refined the mesh.", is_refined, |r| {
        Some((r.input.problem.refinement.as_ref()?.shots * u64::from(Refinement::RAYS)).to_string())
    }),
    column("error_l2", "Relative root mean square error of radiosities.", has_errors, |r| {
        scientific(r.errors()?.l2)
    }),
    column("error_max", "Greatest error of a patch, relative likewise.", has_errors, |r| {
        scientific(r.errors()?.maximum)
    }),
    column("reference_error", "Error of the reference itself.", has_errors, |r| {
        scientific(r.errors()?.reference)
    }),
    column("error_stopping", "Error from what was not shot.", has_causes, |r| {
        scientific(r.causes()?.stopping)
    }),
    column("error_directions", "Error from a finite number of rays.", has_causes, |r| {
        scientific(r.causes()?.directions)
    }),
    column("error_sampling", "Error from shooting at patch centres.", has_causes, |r| {
        scientific(r.causes()?.sampling)
    }),
    column("error_mesh", "Error from the size of patches.", has_causes, |r| {
        scientific(r.causes()?.mesh)
    }),
    column("target_l2", "Error asked for.", is_tuned, |r| text(r.input.tuned?.target)),
    column("predicted_l2", "Error estimated for the setting found.", is_tuned, |r| {
        scientific(r.input.tuned?.error)
    }),
    column("predicted_deviation", "Standard error of that estimate.", is_tuned, |r| {
        scientific(r.input.tuned?.deviation)
    }),
    column("predicted_directions", "Predicted error from rays.", is_tuned, |r| {
        scientific(r.input.tuned?.predicted.directions)
    }),
    column("predicted_centre", "Predicted error from patch centres.", is_tuned, |r| {
        scientific(r.input.tuned?.predicted.sampling)
    }),
    column("predicted_mesh", "Predicted error from the mesh.", is_tuned, |r| {
        scientific(r.input.tuned?.predicted.mesh)
    }),
    column("predicted_stopping", "Predicted error from stopping.", is_tuned, |r| {
        scientific(r.input.tuned?.predicted.stopping)
    }),
    column("predicted_time_s", "Predicted time on one processor, s.", is_tuned, |r| {
        fixed(r.input.tuned?.time_s, 6)
    }),
    column("sweep_time_s", "Least time of the sweep below the error, s.", is_tuned, |r| {
        fixed(r.input.tuned?.sweep_time_s?, 6)
    }),
    column("cost_over_sweep", "predicted_time_s over sweep_time_s.", is_tuned, |r| {
        fixed(r.input.tuned?.time_s / r.input.tuned?.sweep_time_s?, 4)
    }),
    column("knobs", "The setting found.", is_tuned, |r| text(r.input.tuned?.knobs)),
];

const fn column(
    name: &'static str,
    about: &'static str,
    shown: fn(&Input) -> bool,
    cell: fn(&Row) -> Option<String>,
) -> Column {
    Column { name, about, shown, cell }
}

fn always(_: &Input) -> bool {
    true
}

fn on_network(run: &Input) -> bool {
    network::tells(run.machine, run.point)
}

fn on_memory(run: &Input) -> bool {
    run.machine.node_memory.is_some()
}

fn on_message_layer(run: &Input) -> bool {
    run.machine.message_layer != MessageLayer::default()
}

fn on_display(run: &Input) -> bool {
    run.machine.display.is_some()
}

fn on_start_up(run: &Input) -> bool {
    run.machine.start_up.is_some()
}

fn on_caches(run: &Input) -> bool {
    !run.machine.processor.caches.is_empty()
}

fn on_translations(run: &Input) -> bool {
    run.machine.processor.translations.is_some()
}

fn in_media(run: &Input) -> bool {
    !run.problem.space.scene.media.is_empty()
}

fn is_refined(run: &Input) -> bool {
    run.problem.refinement.is_some()
}

fn has_errors(run: &Input) -> bool {
    run.point.reference.is_some()
}

fn has_causes(run: &Input) -> bool {
    run.point.error_causes
}

fn is_tuned(run: &Input) -> bool {
    run.tuned.is_some() || run.point.accuracy.is_some()
}

#[expect(clippy::needless_pass_by_value, reason = "numbers and texts alike")]
fn text(value: impl ToString) -> Option<String> {
    Some(value.to_string())
}

fn fixed(value: f64, decimals: usize) -> Option<String> {
    Some(format!("{value:.decimals$}"))
}

fn scientific(value: f64) -> Option<String> {
    Some(format!("{value:.6e}"))
}

/// The columns that results of these runs have, without the swept fields.
pub fn shown(runs: &[Input]) -> Vec<&'static Column> {
    COLUMNS.iter().filter(|column| runs.iter().any(|run| (column.shown)(run))).collect()
}

/// The header of runs.csv: `columns`, and the swept fields that are not among the first of them.
pub fn header(columns: &[&Column], axes: &[Axis]) -> Vec<String> {
    let mut names: Vec<String> = columns.iter().map(|column| column.name.to_owned()).collect();
    let first = names.iter().position(|name| name == SWEPT_AFTER).map_or(0, |last| last + 1);
    let swept = axes.iter().map(|axis| axis.place.to_string());
    let swept: Vec<String> = swept.filter(|name| !names[..first].contains(name)).collect();
    names.splice(first..first, swept);
    names
}

/// The prefix of columns of host times. They are not in runs.csv: they come from host-times.json.
pub const HOST: &str = "host.";

/// Host times of a run, as host-times.json names them.
pub const HOST_TIMES: [&str; 3] = ["cpu_s", "set_up_s", "clock_s"];

/// The column of operations, and the prefix that names a single count of it.
pub const OPERATIONS: [&str; 2] = ["operations", "operations."];

/// All columns that can be drawn: those of runs.csv, each count of operations, host times.
pub fn drawable(runs_csv: Vec<String>) -> Vec<String> {
    let counts = simulator::operations().map(|count| OPERATIONS[1].to_owned() + count);
    let host = HOST_TIMES.iter().map(|time| HOST.to_owned() + time);
    runs_csv.into_iter().chain(counts).chain(host).collect()
}

/// What the columns of runs.csv hold, as a Table Schema (specs.frictionlessdata.io/table-schema).
pub fn runs_schema() -> Value {
    let field = |column: &Column| json!({ "name": column.name, "description": column.about });
    let about = "Columns of runs.csv. Swept fields of the experiment stand after energy_error; \
                 columns of what no run uses are left out.";
    json!({ "description": about, "fields": COLUMNS.iter().map(field).collect::<Vec<_>>() })
}
