//! `virtwall machine replay`: a user's traffic, sent over a machine's network.

use std::fmt::Write as _;
use std::path::PathBuf;

use clap::Args;
use desim::Time;
use lab::OpenMachine;
use multicomputer::{ChannelUse, Machine, Network, NetworkModel, ReplayedMessage, Trace, replay};

use crate::exit::Exit;

/// Which traffic, and over what.
#[derive(Args)]
pub struct Arguments {
    /// The traffic: a JSON list of {"id", "at", "from", "to", "bytes", "after"}
    trace: PathBuf,
    /// Name of a machine, or path to a machine file
    #[arg(long, value_name = "NAME", default_value = "paragon-xps")]
    machine: String,
    /// Model of the network: ideal, loggp, wormhole or flit [default: the machine file's]
    #[arg(long, value_name = "MODEL")]
    network: Option<NetworkModel>,
    /// Write the table to this CSV file, not to standard output
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Write what each channel of the network did to this CSV file
    #[arg(long, value_name = "FILE")]
    channels: Option<PathBuf>,
}

/// Sends the traffic; returns the course of every message as CSV.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    let machine = OpenMachine::load(&arguments.machine)?.machine;
    let file = arguments.trace.display().to_string();
    let text = lab::read_text(&arguments.trace)?;
    let trace = Trace::from_json(&text, &file, machine.nodes()).map_err(Exit::bad_input)?;
    let rung = arguments.network.or(machine.network_model).unwrap_or(NetworkModel::LogGp);
    let mut network = machine.network_on(rung).map_err(Exit::bad_input)?;
    let courses = replay(&trace, network.as_mut(), machine.topology()).map_err(Exit::failure)?;
    if let Some(path) = &arguments.channels {
        let end = courses.iter().map(|course| course.arrived).max().unwrap_or_default();
        let table = channels(&machine, network.as_ref(), end);
        lab::write_file(path, table.as_bytes()).map_err(Exit::bad_input)?;
    }
    let table = table(&trace, &courses);
    let Some(path) = &arguments.out else { return Ok(table) };
    lab::write_file(path, table.as_bytes()).map_err(Exit::bad_input)?;
    Ok(format!("{} messages; their courses are in {}.\n", courses.len(), path.display()))
}

fn table(trace: &Trace, courses: &[ReplayedMessage]) -> String {
    let mut table = "id,from,to,bytes,sent_s,arrived_s,blocked_s,blocked_by\n".to_owned();
    for (item, course) in trace.messages.iter().zip(courses) {
        let (sent, arrived) = (seconds(course.sent.0), seconds(course.arrived.0));
        let blocked = seconds(course.blocked().0);
        let by = course.blockers().into_iter().map(|index| trace.messages[index].name.as_str());
        let by = by.collect::<Vec<_>>().join(" ");
        let (name, from, to, bytes) = (&item.name, item.from, item.to, item.bytes);
        let _ = writeln!(table, "{name},{from},{to},{bytes},{sent},{arrived},{blocked},{by}");
    }
    table
}

/// What each channel did until `end`; nothing on networks that do not know channels.
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
