//! `virtwall machine replay`: sends the messages of a file over a machine's network.

use std::path::PathBuf;

use clap::Args;
use desim::Time;
use lab::{MachineFile, Table};
use multicomputer::{
    ChannelUse, Machine, Network, ReplayedMessage, StalledSchedule, TraceMessage, Workload,
    perform, replay,
};

use super::network::NetworkArgument;
use crate::exit::Exit;
use crate::files::{check_writable, write};

#[derive(Args)]
pub struct Arguments {
    /// The messages: a JSON list of {"id", "at", "from", "to", "bytes", "after"}; a .goal file, the schedule of
    /// LogGOPSim; or a .csv file with the columns cycle or time, source, destination, bytes or flits
    trace: PathBuf,
    /// Name of a machine, or path to a machine file
    #[arg(long, value_name = "NAME", default_value = "paragon-xps")]
    machine: String,
    #[command(flatten)]
    network: NetworkArgument,
    /// Write the table to this CSV file instead of printing it
    #[arg(short, long = "output", alias = "out", value_name = "FILE")]
    out: Option<PathBuf>,
    /// Write the use of each channel of the network to this CSV file
    #[arg(long, value_name = "FILE")]
    channels: Option<PathBuf>,
}

type Replayed = Vec<(TraceMessage, ReplayedMessage)>;

/// Sends the messages; returns when and how each of them arrived, as CSV.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    arguments.out.iter().chain(&arguments.channels).try_for_each(|path| check_writable(path))?;
    let machine = MachineFile::open(&arguments.machine)?.machine;
    let model = arguments.network.model(&machine);
    let mut network = machine.network_on(model).map_err(Exit::bad_input)?;
    let (replayed, end) = send(arguments, &machine, network.as_mut())?;
    if end == Time::MAX {
        return Err(Exit::failure("a message arrives later than virtual time lasts (213 days)"));
    }
    if let Some(path) = &arguments.channels {
        write(path, csv(&channels(&machine, network.as_ref(), end))?)?;
    }
    let table = csv(&table(&replayed))?;
    let Some(path) = &arguments.out else { return Ok(table) };
    write(path, table)?;
    Ok(format!("{} messages; the table is in {}.\n", replayed.len(), path.display()))
}

/// The messages of the file with their times, and the end of all.
fn send(
    arguments: &Arguments,
    machine: &Machine,
    network: &mut dyn Network,
) -> Result<(Replayed, Time), Exit> {
    let file = &arguments.trace;
    let links = machine.parameters.links.as_ref();
    let trace = match Workload::read(file, machine.nodes(), links).map_err(Exit::bad_input)? {
        Workload::Trace(trace) => trace,
        Workload::Schedule(schedule) => {
            return perform(&schedule, network).map_err(|stalled| match stalled {
                StalledSchedule::Network { .. } => Exit::failure(stalled),
                StalledSchedule::Operations { .. } => {
                    Exit::bad_input(format!("{}: {stalled}", file.display()))
                }
            });
        }
    };
    let replayed = replay(&trace, network, machine.topology()).map_err(Exit::failure)?;
    let end = replayed.iter().map(|message| message.arrived).max().unwrap_or_default();
    Ok((trace.messages.into_iter().zip(replayed).collect(), end))
}

fn table(replayed: &Replayed) -> Table {
    let row = |(message, times): &(TraceMessage, ReplayedMessage)| {
        let by = times.blockers().into_iter().map(|index| replayed[index].0.name.as_str());
        vec![
            message.name.clone(),
            message.from.to_string(),
            message.to.to_string(),
            message.bytes.to_string(),
            seconds(times.sent.0),
            seconds(times.arrived.0),
            seconds(times.blocked().0),
            by.collect::<Vec<_>>().join(" "),
        ]
    };
    let columns = ["id", "from", "to", "bytes", "sent_s", "arrived_s", "blocked_s", "blocked_by"];
    Table { columns: columns.map(str::to_owned).to_vec(), rows: replayed.iter().map(row).collect() }
}

/// The use of each channel until `end`; empty on network models without channels.
fn channels(machine: &Machine, network: &dyn Network, end: Time) -> Table {
    let row = |ChannelUse { channel, messages, carrying, held }| {
        let utilisation = carrying.as_seconds_f64() / end.as_seconds_f64().max(1e-12);
        vec![
            channel.describe(machine.topology()),
            messages.to_string(),
            seconds(carrying.0),
            seconds(held.0),
            format!("{utilisation:.6}"),
        ]
    };
    let columns = ["channel", "messages", "carrying_s", "held_s", "utilisation"];
    Table {
        columns: columns.map(str::to_owned).to_vec(),
        rows: network.channel_use().into_iter().map(row).collect(),
    }
}

fn csv(table: &Table) -> Result<String, Exit> {
    let bytes = table.to_csv().map_err(Exit::failure)?;
    String::from_utf8(bytes).map_err(Exit::failure)
}

/// Ticks of 1 ps as exact decimals of a second.
fn seconds(ticks: u64) -> String {
    let one = 10_u64.pow(12);
    format!("{}.{:012}", ticks / one, ticks % one)
}
