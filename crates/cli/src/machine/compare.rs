//! `virtwall machine compare`: the wormhole model of a machine's network compared with the flit model.

use std::fmt::Write as _;

use clap::Args;
use desim::{Duration, Time};
use lab::MachineFile;
use multicomputer::{
    Load, LogGpParameters, Machine, Measured, NetworkModel, NetworkParameters, Pattern,
    fluid_bound, replay,
};

use crate::exit::Exit;

/// Loads, as shares of the fluid bound: what the busiest channel can carry.
const LOADS: [f64; 8] = [0.02, 0.1, 0.2, 0.3, 0.4, 0.5, 0.7, 0.9];
/// A network is saturated where latency exceeds that of the lightest load by this factor.
const SATURATED: f64 = 3.0;
/// Expected agreement of the two below saturation.
const NEAR: f64 = 0.15;

#[derive(Args)]
pub struct Arguments {
    /// Name of a machine, or path to a machine file
    machine: String,
    /// Bytes per message
    #[arg(long, value_name = "N", default_value_t = 4_096, value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    bytes: u64,
    /// Mean number of messages per node
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u64).range(4..=10_000))]
    messages: u64,
    /// Include the cost of the message layer, which hides differences between networks
    #[arg(long)]
    software: bool,
    /// Seed of the random traffic
    #[arg(long, value_name = "N", default_value_t = 1996)]
    seed: u64,
}

/// Compares; returns a table and the largest difference.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    let machine = MachineFile::open(&arguments.machine)?.machine;
    machine.network_on(NetworkModel::Flit).map_err(Exit::bad_input)?;
    let mut text = format!("{}, messages of {} B\n", machine.title, arguments.bytes);
    text += "pattern        load  messages   wormhole us       flit us  difference\n";
    let mut largest = (0.0_f64, String::new());
    for pattern in Pattern::ALL {
        let mut empty = None;
        for load in LOADS {
            let [wormhole, flit] = measure(&machine, arguments, pattern, load)?;
            let name = pattern.name();
            if wormhole.messages == 0 {
                let _ = writeln!(text, "{name:<12}{:>6.0} %  no node has a partner", load * 100.0);
                break;
            }
            let difference = wormhole.latency / flit.latency - 1.0;
            let saturated = flit.latency > SATURATED * *empty.get_or_insert(flit.latency);
            let _ = writeln!(
                text,
                "{name:<12}{:>5.0} %{:>10}{:>14.2}{:>14.2}{:>10.1} %{}",
                load * 100.0,
                wormhole.messages,
                wormhole.latency * 1e6,
                flit.latency * 1e6,
                difference * 100.0,
                if saturated { "  saturated" } else { "" }
            );
            if saturated {
                break;
            }
            if difference.abs() > largest.0.abs() {
                largest = (difference, format!("{name} at {:.0} %", load * 100.0));
            }
        }
    }
    let (difference, place) = largest;
    let verdict = if difference.abs() <= NEAR { "within" } else { "NOT within" };
    let percent = difference * 100.0;
    let _ = writeln!(
        text,
        "\nLoads are shares of what the busiest channel can carry. Below saturation mean latencies \
         differ by {percent:.1} % at most ({place}): {verdict} {:.0} %.",
        NEAR * 100.0
    );
    Ok(text)
}

/// Sends the same traffic over both models.
fn measure(
    machine: &Machine,
    arguments: &Arguments,
    pattern: Pattern,
    share: f64,
) -> Result<[Measured; 2], Exit> {
    let Arguments { bytes, messages, seed, software, .. } = *arguments;
    let (topology, nodes) = (machine.topology(), machine.compute_nodes());
    let mut parameters = machine.parameters.clone();
    let NetworkParameters { software: Some(layer), links: Some(links) } = &mut parameters else {
        return Err(Exit::bad_input("the machine's network has no links"));
    };
    if !software {
        *layer = LogGpParameters::bare(layer.hop_time, links.bandwidth);
    }
    // A node cannot send faster than its message layer.
    let bound = fluid_bound(pattern, topology, nodes, links).min(layer.bandwidth);
    let every = Duration::from_seconds_f64(bytes as f64 / (share * bound));
    let load = Load { pattern, bytes, every, until: Time::ZERO + every * messages, seed };
    let trace = load.trace(topology, nodes);
    let on = |model| {
        let network = parameters.build(model, topology);
        let mut network = network.ok_or_else(|| Exit::failure("no such network"))?;
        let replayed = replay(&trace, network.as_mut(), topology).map_err(Exit::failure)?;
        Ok::<_, Exit>(Measured::of(&load, &trace, &replayed))
    };
    Ok([on(NetworkModel::Wormhole)?, on(NetworkModel::Flit)?])
}
