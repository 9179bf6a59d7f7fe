//! The columns that every runs.csv has.

use crate::table::column::{Column, Input, column, fixed, text};

pub const EVERY_RUN: &[Column] = &[
    column("scene", "text", "Scene (§5.1).", always, |r| text(&r.input.point.scene)),
    column("processors", "count", "Compute nodes used (Table 1).", always, |r| {
        text(r.input.point.processors)
    }),
    column(
        "local_environments",
        "count",
        "Local environments that the scene is cut into (§3.1).",
        always,
        |r| text(r.input.point.local_environments),
    ),
    column("seed", "number", "Seed of all random choices.", always, |r| text(r.input.point.seed)),
    column("time_s", "s", "Virtual time of the run (Table 1). Empty on threads.", always, |r| {
        fixed(r.figures?.time_s?, 6)
    }),
    column(
        "speed_up",
        "ratio",
        "Time on one processor, or on as many as speed_up_over says, all else equal, over time_s (Table 1). Empty on threads.",
        always,
        |r| fixed(r.speed_up?, 4),
    ),
    column(
        "paper_time_s",
        "s",
        "Published time, from the file of compare_with (Table 1).",
        always,
        |r| text(&r.published.time_s),
    ),
    column(
        "paper_speed_up",
        "ratio",
        "Published speed-up, from the file of compare_with (Table 1).",
        always,
        |r| text(&r.published.speed_up),
    ),
    column(
        "local_shots",
        "count",
        "Patches shot in their own local environments (§4.2.3).",
        always,
        |r| text(r.figures?.local_shots),
    ),
    column("received_shots", "count", "Received sources shot (§4.2.2).", always, |r| {
        text(r.figures?.received_shots)
    }),
    column("messages", "count", "Sources sent from node to node (§4.2.3).", always, |r| {
        text(r.figures?.messages)
    }),
    column(
        "message_bytes",
        "B",
        "Size of the sources sent from node to node, summed (§4.2.3).",
        always,
        |r| text(r.figures?.message_bytes),
    ),
    column(
        "busy_fraction",
        "ratio",
        "Share of their time that nodes compute. Empty on threads.",
        always,
        |r| fixed(r.figures?.busy_fraction?, 6),
    ),
    column(
        "energy_error",
        "ratio",
        "Error of the energy balance, over the emitted energy.",
        always,
        |r| text(format_args!("{:e}", r.figures?.energy_error)),
    ),
    column(
        "efficiency",
        "ratio",
        "Speed-up over processors, times those that it is relative to. Empty on threads.",
        always,
        |r| {
            let base = r.input.point.speed_up_over.unwrap_or(1);
            fixed(r.speed_up? * f64::from(base) / f64::from(r.input.point.processors), 4)
        },
    ),
    column(
        "update_messages",
        "count",
        "Radiosity updates to the service node (Figure 6).",
        always,
        |r| text(r.figures?.update_messages),
    ),
    column("update_bytes", "B", "Size of the updates to the service node, summed.", always, |r| {
        text(r.figures?.update_bytes)
    }),
    column(
        "control_messages",
        "count",
        "Tokens, energy reports and other control (§4.2.4).",
        always,
        |r| text(r.figures?.control_messages),
    ),
    column("ending", "text", "How it ended: agreed, too_early or failed (§4.2.4).", always, |r| {
        match r.figures {
            Some(figures) => text(figures.too_early.map_or("agreed", |_| "too_early")),
            None => r.failure.map(|_| "failed".to_owned()),
        }
    }),
    column(
        "energy_lost",
        "ratio",
        "Share of the emitted energy lost by ending too early.",
        always,
        |r| text(format_args!("{:e}", r.figures?.too_early.unwrap_or(0.0))),
    ),
    column("patches", "count", "Patches of the scene.", always, |r| text(r.figures?.patches)),
    column(
        "absorbed",
        "ratio",
        "Share of the emitted energy that surfaces absorbed.",
        always,
        |r| fixed(r.figures?.energy.absorbed, 9),
    ),
    column(
        "unshot",
        "ratio",
        "Share of the emitted energy that patches have not shot.",
        always,
        |r| fixed(r.figures?.energy.unshot, 9),
    ),
    column(
        "in_transit",
        "ratio",
        "Share of the emitted energy between local environments.",
        always,
        |r| fixed(r.figures?.energy.in_transit, 9),
    ),
    column("escaped", "ratio", "Share of the emitted energy that left the scene.", always, |r| {
        fixed(r.figures?.energy.escaped, 9)
    }),
    column(
        "operations",
        "text",
        "Operations counted, by name; each is also a column operations.NAME.",
        always,
        |r| {
            let counts = r.figures?.work.iter().map(|(name, count)| format!("{name}={count}"));
            Some(counts.collect::<Vec<_>>().join(" "))
        },
    ),
    column("failure", "text", "Why the run failed.", always, |r| r.failure.map(str::to_owned)),
];

fn always(_: &Input) -> bool {
    true
}
