//! The columns of what only some runs use.

use multicomputer::MessageLayer;
use radiosity::Refinement;

use crate::engine::network;
use crate::table::column::{Column, Input, column, fixed, scientific, text};

pub const FEATURES: &[Column] = &[
    column("network_used", "text", "Network model used.", on_network, |r| {
        text(&r.network()?.model)
    }),
    column(
        "network_why",
        "text",
        "Why this network model, if it was chosen automatically.",
        on_network,
        |r| text(&r.network()?.why),
    ),
    column(
        "difference_from_finest",
        "%",
        "Time against that on the finest network model run, all else equal.",
        on_network,
        |r| text(format_args!("{:.6} %", r.difference_from_finest? * 100.0)),
    ),
    column(
        "busiest_link",
        "ratio",
        "Share of time that the busiest link is used.",
        on_network,
        |r| fixed(r.network()?.busiest_link?, 6),
    ),
    column("blocked_s", "s", "Time that messages delayed each other, summed.", on_network, |r| {
        fixed(r.network()?.blocked_s, 9)
    }),
    column("memory_high_water", "B", "Most memory used on one node.", on_memory, |r| {
        text(r.figures?.memory?.high_water)
    }),
    column("paging_s", "s", "Time that nodes waited for pages, summed.", on_memory, |r| {
        fixed(r.figures?.memory?.paging_s, 6)
    }),
    column("packing_s", "s", "Time spent on making packets, summed.", on_message_layer, |r| {
        fixed(r.figures?.message_layer?.packing_s, 9)
    }),
    column(
        "copying_s",
        "s",
        "Time spent on copying unposted messages, summed.",
        on_message_layer,
        |r| fixed(r.figures?.message_layer?.copying_s, 9),
    ),
    column(
        "waiting_for_room_s",
        "s",
        "Time waiting for room in buffers, summed.",
        on_message_layer,
        |r| fixed(r.figures?.message_layer?.waiting_for_room_s, 9),
    ),
    column(
        "coprocessor_s",
        "s",
        "Busy time of message coprocessors, summed.",
        on_message_layer,
        |r| fixed(r.figures?.message_layer?.coprocessor_s, 9),
    ),
    column(
        "unposted_messages",
        "count",
        "Messages without a posted receive.",
        on_message_layer,
        |r| text(r.figures?.message_layer?.unposted_messages),
    ),
    column(
        "held_messages",
        "count",
        "Messages that waited for room in buffers.",
        on_message_layer,
        |r| text(r.figures?.message_layer?.held_messages),
    ),
    column(
        "buffer_bytes_most",
        "B",
        "Most that was used of a node's buffers.",
        on_message_layer,
        |r| text(r.figures?.message_layer?.buffer_bytes_most),
    ),
    column("display_lag_s", "s", "Time from the end until all is shown.", on_display, |r| {
        fixed(r.figures?.display?.lag_s, 6)
    }),
    column("updates_shown", "count", "Updates that the display has taken.", on_display, |r| {
        text(r.figures?.display?.shown)
    }),
    column("updates_dropped", "count", "Updates that the display never got.", on_display, |r| {
        text(r.figures?.display?.dropped)
    }),
    column(
        "waiting_for_display_s",
        "s",
        "Time that nodes waited for the display, summed.",
        on_display,
        |r| fixed(r.figures?.display?.waiting_s, 6),
    ),
    column(
        "service_busy_fraction",
        "ratio",
        "Share of time the service node works.",
        on_display,
        |r| fixed(r.figures?.display?.service_busy, 6),
    ),
    column(
        "ethernet_busy_fraction",
        "ratio",
        "Share of time the Ethernet is used.",
        on_display,
        |r| fixed(r.figures?.display?.ethernet_busy, 6),
    ),
    column("display_busy_fraction", "ratio", "Share of time the display works.", on_display, |r| {
        fixed(r.figures?.display?.display_busy, 6)
    }),
    column("start_up_s", "s", "Time until all nodes are ready (§4.2.1).", on_start_up, |r| {
        fixed(r.figures?.start_up?.start_up_s, 6)
    }),
    column(
        "reading_s",
        "s",
        "Of start_up_s, until the last node has read the scene (§4.2.1).",
        on_start_up,
        |r| fixed(r.figures?.start_up?.reading_s, 6),
    ),
    column("disk_wait_s", "s", "Of start_up_s, that node's wait at I/O nodes.", on_start_up, |r| {
        fixed(r.figures?.start_up?.disk_wait_s, 6)
    }),
    column("missing_s", "s", "Time spent on cache misses, summed (§5.2).", on_caches, |r| {
        fixed(r.figures?.missing_s?, 6)
    }),
    column(
        "gain",
        "ratio",
        "Time with one local environment over time_s (Figure 11).",
        on_caches,
        |r| fixed(r.gain?, 4),
    ),
    column(
        "translating_s",
        "s",
        "Time spent on address translation, summed.",
        on_translations,
        |r| fixed(r.figures?.translating_s?, 6),
    ),
    column(
        "absorbed_by_media",
        "ratio",
        "Share of the energy that media absorbed.",
        in_media,
        |r| fixed(r.figures?.energy.medium, 9),
    ),
    column(
        "pilot_rays",
        "count",
        "Rays of the pilot run that refined the mesh.",
        is_refined,
        |r| {
            Some(
                (r.input.problem.refinement.as_ref()?.shots * u64::from(Refinement::RAYS))
                    .to_string(),
            )
        },
    ),
    column(
        "error_l2",
        "ratio",
        "Relative root mean square error of radiosities.",
        has_errors,
        |r| scientific(r.errors()?.l2),
    ),
    column(
        "error_max",
        "ratio",
        "Greatest error of a patch, relative to the root mean square likewise.",
        has_errors,
        |r| scientific(r.errors()?.maximum),
    ),
    column("reference_error", "ratio", "Error of the reference itself.", has_errors, |r| {
        scientific(r.errors()?.reference)
    }),
    column("error_stopping", "ratio", "Error from what was not shot.", has_causes, |r| {
        scientific(r.causes()?.stopping)
    }),
    column("error_directions", "ratio", "Error from a finite number of rays.", has_causes, |r| {
        scientific(r.causes()?.directions)
    }),
    column("error_sampling", "ratio", "Error from shooting at patch centres.", has_causes, |r| {
        scientific(r.causes()?.sampling)
    }),
    column("error_mesh", "ratio", "Error from the size of patches.", has_causes, |r| {
        scientific(r.causes()?.mesh)
    }),
    column("target_l2", "ratio", "Error asked for, relative root mean square.", is_tuned, |r| {
        text(r.input.tuned?.target)
    }),
    column("predicted_l2", "ratio", "Error estimated for the setting found.", is_tuned, |r| {
        scientific(r.input.tuned?.error)
    }),
    column("predicted_deviation", "ratio", "Standard error of that estimate.", is_tuned, |r| {
        scientific(r.input.tuned?.deviation)
    }),
    column(
        "predicted_directions",
        "ratio",
        "Predicted error from a finite number of rays.",
        is_tuned,
        |r| scientific(r.input.tuned?.predicted.directions),
    ),
    column(
        "predicted_centre",
        "ratio",
        "Predicted error from shooting at patch centres.",
        is_tuned,
        |r| scientific(r.input.tuned?.predicted.sampling),
    ),
    column("predicted_mesh", "ratio", "Predicted error from the size of patches.", is_tuned, |r| {
        scientific(r.input.tuned?.predicted.mesh)
    }),
    column(
        "predicted_stopping",
        "ratio",
        "Predicted error from what was not shot.",
        is_tuned,
        |r| scientific(r.input.tuned?.predicted.stopping),
    ),
    column("predicted_time_s", "s", "Predicted time on one processor.", is_tuned, |r| {
        fixed(r.input.tuned?.time_s, 6)
    }),
    column("sweep_time_s", "s", "Least time of the sweep below the error.", is_tuned, |r| {
        fixed(r.input.tuned?.sweep_time_s?, 6)
    }),
    column("cost_over_sweep", "ratio", "predicted_time_s over sweep_time_s.", is_tuned, |r| {
        fixed(r.input.tuned?.time_s / r.input.tuned?.sweep_time_s?, 4)
    }),
    column("knobs", "text", "The setting found.", is_tuned, |r| text(r.input.tuned?.knobs)),
];

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
