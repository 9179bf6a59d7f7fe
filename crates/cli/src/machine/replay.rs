//! `virtwall machine replay`: sends the messages of a trace file over a machine's network.

use std::fmt::Write as _;
use std::path::PathBuf;

use clap::Args;
use desim::Time;
use lab::MachineFile;
use multicomputer::{ChannelUse, Machine, Network, ReplayedMessage, Trace, replay};

use super::network::NetworkArgument;
use crate::exit::Exit;
use crate::files::write;

#[derive(Args)]
pub struct Arguments {
    /// The messages: a JSON list of {"id", "at", "from", "to", "bytes", "after"}
    trace: PathBuf,
    /// Name of a machine, or path to a machine file
    #[arg(long, value_name = "NAME", default_value = "paragon-xps")]
    machine: String,
    #[command(flatten)]
    network: NetworkArgument,
    /// Write the table to this CSV file instead of printing it
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Write the use of each channel of the network to this CSV file
    #[arg(long, value_name = "FILE")]
    channels: Option<PathBuf>,
}

/// Sends the messages; returns when and how each of them arrived, as CSV.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    let machine = MachineFile::open(&arguments.machine)?.machine;
    let file = arguments.trace.display().to_string();
    let text = config::read_text(&arguments.trace)?;
    let trace = Trace::from_json(&text, &file, machine.nodes()).map_err(Exit::bad_input)?;
    let model = arguments.network.model(&machine);
    let mut network = machine.network_on(model).map_err(Exit::bad_input)?;
    let replayed = replay(&trace, network.as_mut(), machine.topology()).map_err(Exit::failure)?;
    if let Some(path) = &arguments.channels {
        let end = replayed.iter().map(|message| message.arrived).max().unwrap_or_default();
        let table = channels(&machine, network.as_ref(), end);
        write(path, table)?;
    }
    let table = table(&trace, &replayed);
    let Some(path) = &arguments.out else { return Ok(table) };
    write(path, table)?;
    Ok(format!("{} messages; the table is in {}.\n", replayed.len(), path.display()))
}

fn table(trace: &Trace, replayed: &[ReplayedMessage]) -> String {
    let mut table = "id,from,to,bytes,sent_s,arrived_s,blocked_s,blocked_by\n".to_owned();
    for (message, replayed) in trace.messages.iter().zip(replayed) {
        let (sent, arrived) = (seconds(replayed.sent.0), seconds(replayed.arrived.0));
        let blocked = seconds(replayed.blocked().0);
        let by = replayed.blockers().into_iter().map(|index| trace.messages[index].name.as_str());
        let by = by.collect::<Vec<_>>().join(" ");
        let (name, from, to, bytes) = (&message.name, message.from, message.to, message.bytes);
        let _ = writeln!(table, "{name},{from},{to},{bytes},{sent},{arrived},{blocked},{by}");
    }
    table
}

/// The use of each channel until `end`; empty on network models without channels.
fn channels(machine: &Machine, network: &dyn Network, end: Time) -> String {
    let mut table = "channel,messages,carrying_s,held_s,utilisation\n".to_owned();
    for ChannelUse { channel, messages, carrying, held } in network.channel_use() {
        let name = channel.describe(machine.topology());
        let utilisation = carrying.as_seconds_f64() / end.as_seconds_f64().max(1e-12);
        let (carrying, held) = (seconds(carrying.0), seconds(held.0));
        let _ = writeln!(table, "{name},{messages},{carrying},{held},{utilisation:.6}");
    }
    table
}

/// Ticks of 1 ps as exact decimals of a second.
fn seconds(ticks: u64) -> String {
    let one = 10_u64.pow(12);
    format!("{}.{:012}", ticks / one, ticks % one)
}
