//! `virtwall machine bench`: ping-pong, exchange and hot spot on a machine's network, by message size.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::Args;
use desim::Time;
use lab::{MachineFile, Plot, Table};
use multicomputer::{KernelError, Machine, Network, NetworkModel, exchange, hot_spot, ping_pong};
use serde_json::json;

use super::network::{NetworkArgument, caveat};
use crate::exit::Exit;
use crate::files::{make_folder, write};

/// Bytes of the messages.
const SIZES: [u64; 10] = [8, 32, 128, 512, 2_048, 4_096, 16_384, 65_536, 262_144, 1_048_576];
/// The longest of them on the flit model, where megabytes would take hours.
const LONGEST_OF_FLITS: u64 = 4_096;
/// Messages each way, and rounds.
const ROUNDS: u32 = 10;

#[derive(Args)]
pub struct Arguments {
    /// Name of a machine, or path to a machine file
    machine: String,
    #[command(flatten)]
    network: NetworkArgument,
    /// Write the table (bench.csv) and its plots to this folder
    #[arg(short, long = "output", alias = "out", value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Measures; returns the table.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    let machine = MachineFile::open(&arguments.machine)?.machine;
    let model = arguments.network.model(&machine);
    machine.network_on(model).map_err(Exit::bad_input)?;
    let most = if model == NetworkModel::Flit { LONGEST_OF_FLITS } else { u64::MAX };
    let sizes = SIZES.into_iter().filter(|&bytes| bytes <= most);
    let rows = sizes
        .map(|bytes| row(&machine, model, bytes))
        .collect::<Result<Vec<_>, _>>()
        .map_err(Exit::failure)?;
    let columns = [
        "bytes",
        "microseconds_one_way",
        "published_microseconds_one_way",
        "megabytes_a_second",
        "published_megabytes_a_second",
        "exchange_microseconds",
        "hot_spot_microseconds",
    ];
    let table = Table { columns: columns.map(str::to_owned).to_vec(), rows };
    let text = text(&machine, model, &table);
    let Some(out) = &arguments.out else { return Ok(text) };
    draw(&table, model, out)?;
    Ok(format!("{text}\nTable and plots are in {}.\n", out.display()))
}

/// Ping-pong of neighbours, exchange of all nodes, and all to one, with messages of this size.
fn row(machine: &Machine, model: NetworkModel, bytes: u64) -> Result<Vec<String>, KernelError> {
    let network = || -> Result<Box<dyn Network>, KernelError> { Ok(machine.network_on(model)?) };
    let ranks = machine.compute_nodes();
    let partner = 1.min(ranks - 1);
    let there_and_back = ping_pong(machine, network()?, (0, partner), bytes, ROUNDS)?;
    let one_way = there_and_back.as_seconds_f64() / f64::from(2 * ROUNDS);
    let exchange = exchange(machine, network()?, ranks, bytes, ROUNDS);
    let hot_spot = hot_spot(machine, network()?, ranks, bytes, ROUNDS);
    let messages = (ranks - 1).max(1) as f64 * f64::from(ROUNDS);
    let each = |time: Result<Time, KernelError>, count: f64| match time {
        Ok(time) => Ok(format!("{:.2}", time.as_seconds_f64() * 1e6 / count)),
        Err(KernelError::Stalled(_)) => Ok("deadlock".to_owned()),
        Err(error) => Err(error),
    };
    let published = &machine.published;
    let latency = published.latency.filter(|_| bytes == SIZES[0]);
    let bandwidth = published.bandwidth.filter(|_| bytes == SIZES[SIZES.len() - 1]);
    let optional = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:.2}"));
    Ok(vec![
        bytes.to_string(),
        format!("{:.2}", one_way * 1e6),
        optional(latency.map(|latency| latency.as_seconds_f64() * 1e6)),
        optional((one_way > 0.0).then(|| bytes as f64 / one_way / 1e6)),
        optional(bandwidth.map(|bandwidth| bandwidth / 1e6)),
        each(exchange, f64::from(ROUNDS))?,
        each(hot_spot, messages)?,
    ])
}

fn text(machine: &Machine, model: NetworkModel, table: &Table) -> String {
    let mut text = format!("{}, network {model}\n\n", machine.title);
    text += "    bytes   one way us       MB/s  exchange us    hot spot us/message\n";
    for row in &table.rows {
        let [bytes, one_way, _, bandwidth, _, exchange, hot_spot] = &row[..] else { continue };
        let _ =
            writeln!(text, "{bytes:>9}{one_way:>13}{bandwidth:>11}{exchange:>13}{hot_spot:>23}");
    }
    let published = &machine.published;
    let latency = published.latency.map(|latency| format!("latency {latency}"));
    let bandwidth = published.bandwidth.map(|b| format!("bandwidth {} MB/s", b / 1e6));
    let published: Vec<String> = latency.into_iter().chain(bandwidth).collect();
    if !published.is_empty() {
        let _ = writeln!(text, "\nPublished: {}.", published.join(", "));
    }
    let notes = [caveat(model, machine), faster_than_alone(table)];
    notes.into_iter().flatten().for_each(|note| text += &format!("\n{note}\n"));
    text
}

/// Says so if a node receives from several senders more bytes a second than from one.
fn faster_than_alone(table: &Table) -> Option<String> {
    let row = table.rows.last()?;
    let number = |column| table.number(row, column);
    let (bytes, each) = (number("bytes")?, number("hot_spot_microseconds")?);
    let (all, one) = (bytes / each, number("megabytes_a_second")?);
    // A megabyte per second is a byte per microsecond. The last digits of short times are rounded.
    (each > 0.0 && all > 1.1 * one).then(|| {
        format!(
            "In the hot spot a node receives {all:.0} MB/s, from one sender {one:.0} MB/s: a sender's software \
             limits it, and messages of several senders arrive at the pace of links (choice C20)."
        )
    })
}

/// Draws the table; titles name the model, on which the times of several messages at once depend.
fn draw(table: &Table, model: NetworkModel, out: &Path) -> Result<(), Exit> {
    make_folder(out, "results")?;
    write(&out.join("bench.csv"), table.to_csv().map_err(Exit::failure)?)?;
    for (y, title) in [
        ("microseconds_one_way", "Time of a message between neighbours"),
        ("megabytes_a_second", "Bandwidth between neighbours"),
        ("exchange_microseconds", "Exchange of every node with four neighbours"),
        ("hot_spot_microseconds", "All nodes to one: time per message"),
    ] {
        let title = format!("{title}, model {model}");
        let plot = json!({ "x": "bytes", "y": y, "title": title, "log_x": true, "log_y": true });
        let plot: Plot = serde_json::from_value(plot).map_err(Exit::failure)?;
        write(&out.join(plot.file_name()), lab::svg(table, &plot))?;
    }
    Ok(())
}
