//! The network models compared with SimGrid: the same exchange of messages on the same mesh.

use std::fmt::Write;

use multicomputer::NetworkModel;
use serde::Serialize;

use crate::cpu::{Spread, rounded, timed};
use crate::exchange::{BYTES, COLUMNS, OURS, ROWS, exchange, neighbours, paragon};
use crate::peer::{Peer, Program, Recipe};

pub const SIMGRID: Recipe = Recipe {
    name: "simgrid",
    source: include_str!("../cpp/simgrid.cpp"),
    library: "simgrid",
    packages: "g++ libsimgrid-dev",
};

const ROUNDS: u64 = 1_000;

/// SimGrid's network models with links; the first is its default.
const MODELS: [&str; 2] = ["LV08", "CM02"];

/// The exchange on one network.
#[derive(Serialize)]
pub struct Row {
    /// The simulator and its network model.
    pub network: String,
    /// Messages of the exchange.
    pub messages: u64,
    /// Virtual seconds that it takes.
    pub virtual_seconds: f64,
    /// Messages simulated per second by one thread: median, least and greatest of the rounds.
    pub messages_per_second: f64,
    pub least: f64,
    pub greatest: f64,
    /// The median relative to that of SimGrid's default model.
    pub this_over_simgrid: f64,
}

/// Messages, virtual seconds; processor seconds.
type Measured = (u64, f64, f64);

/// Measures all networks: after a warm-up round, `rounds` rounds in which each network runs the exchange once.
pub fn measure(simgrid: &Program, rounds: u16) -> Result<Vec<Row>, String> {
    let mut version = String::new();
    let mut measured: Vec<Vec<Measured>> = vec![Vec::new(); OURS.len() + MODELS.len()];
    for round in 0..=rounds {
        for (network, measured) in measured.iter_mut().enumerate() {
            let figures = match OURS.get(network) {
                Some(&model) => ours(model),
                None => theirs(simgrid, MODELS[network - OURS.len()], &mut version)?,
            };
            if round > 0 {
                measured.push(figures);
            }
        }
    }
    let names = OURS.iter().map(|model| format!("Virtwall, {model}"));
    let names = names.chain(MODELS.map(|model| format!("SimGrid {version}, {model}")));
    let rate = |measured: &Vec<Measured>| {
        Spread::of(measured.iter().map(|(messages, _, cpu)| *messages as f64 / cpu).collect())
    };
    let default = rate(&measured[OURS.len()]).median;
    let rows = names.zip(&measured).map(|(network, measured)| {
        let ((messages, virtual_seconds, _), rate) = (measured[0], rate(measured));
        Row {
            network,
            messages,
            virtual_seconds,
            messages_per_second: rate.median.round(),
            least: rate.least.round(),
            greatest: rate.greatest.round(),
            this_over_simgrid: rounded(rate.median / default),
        }
    });
    Ok(rows.collect())
}

fn ours(model: NetworkModel) -> Measured {
    let ((messages, end), seconds) = timed(|| exchange(model, ROUNDS));
    (messages, end.as_seconds_f64(), seconds)
}

fn theirs(simgrid: &Program, model: &str, version: &mut String) -> Result<Measured, String> {
    let model = format!("--cfg=network/model:{model}");
    let mut peer = Peer::start(simgrid, &[&model, "--log=xbt_cfg.thresh:warning"])?;
    peer.write(&problem())?;
    *version = peer.line()?;
    let (seconds, messages, virtual_seconds) = peer.figures()?;
    Ok((messages, virtual_seconds, seconds))
}

/// The exchange in the format that `simgrid.cpp` reads. SimGrid has no processor overhead of a message; the
/// Paragon's is added to the latency.
fn problem() -> String {
    let p = paragon().parameters.software.expect("the Paragon's file has them");
    let latency = (p.send_overhead + p.latency + p.receive_overhead).as_seconds_f64();
    let (bandwidth, hop) = (p.bandwidth, p.hop_time.as_seconds_f64());
    let mut text = format!("{COLUMNS} {ROWS} {ROUNDS} {BYTES} {bandwidth} {latency} {hop}\n");
    for to in (0..COLUMNS * ROWS).flat_map(neighbours) {
        writeln!(text, "{to}").expect("writing to a String does not fail");
    }
    text
}

pub fn table(rows: &[Row]) -> String {
    let mut text = format!(
        "\n{} nodes, 4 neighbours, {BYTES} bytes, {ROUNDS} rounds\n\n\
         | network | messages/s | least–greatest | messages | virtual s | this/SimGrid's default |\n\
         |---|---:|---:|---:|---:|---:|\n",
        COLUMNS * ROWS
    );
    for row in rows {
        let Row {
            network, messages, virtual_seconds, messages_per_second, least, greatest, ..
        } = row;
        let ratio = row.this_over_simgrid;
        writeln!(text, "| {network} | {messages_per_second} | {least}–{greatest} | {messages} | {virtual_seconds:.4} | {ratio:.2} |")
            .expect("writing to a String does not fail");
    }
    text
}
