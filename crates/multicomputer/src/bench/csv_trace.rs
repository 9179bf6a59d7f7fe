//! Traffic as CSV, one message a line, as simulators of networks on chips write it.

use std::collections::BTreeSet;

use config::{Fault, Quantity};
use csv::{ReaderBuilder, StringRecord, Trim};
use desim::{Duration, Time};

use super::trace::{LATEST, MOST_BYTES, Trace, TraceMessage, check_name};
use crate::network::LinkParameters;

const COLUMNS: [&str; 7] = ["id", "cycle", "time", "source", "destination", "bytes", "flits"];

impl Trace {
    /// Reads a CSV text whose first line names its columns: `cycle` (of the links) or `time` (with a unit),
    /// `source`, `destination`, `bytes` or `flits`, and `id` if messages have names. `nodes` and `links` are
    /// the machine's; `file_name` is for messages only.
    ///
    /// # Errors
    /// [`Fault`], with file, line, column, value and what was expected.
    pub fn from_csv(
        text: &str,
        file_name: &str,
        nodes: usize,
        links: Option<&LinkParameters>,
    ) -> Result<Trace, Fault> {
        let fault = |line: usize, message: String| Fault {
            line: Some(line),
            ..Fault::of_file(file_name, message)
        };
        let text = config::json::without_mark(text);
        let mut reader =
            ReaderBuilder::new().trim(Trim::All).comment(Some(b'#')).from_reader(text.as_bytes());
        let broken = |error: csv::Error| {
            let line = error.position().map_or(1, |position| position.line() as usize);
            fault(line, error.to_string())
        };
        let header = reader.headers().map_err(broken)?.clone();
        let columns = Columns::of(&header, links).map_err(|message| fault(1, message))?;
        let mut trace = Trace::default();
        let mut names = BTreeSet::new();
        for (index, record) in reader.records().enumerate() {
            let record = record.map_err(broken)?;
            let line = record.position().map_or(1, |position| position.line() as usize);
            let message = columns.message(&record, index, nodes);
            let message = message.map_err(|message| fault(line, message))?;
            if !names.insert(message.name.clone()) {
                let text = format!("id: found \"{}\" again; expected one of its own", message.name);
                return Err(fault(line, text));
            }
            trace.messages.push(message);
        }
        Ok(trace)
    }
}

/// Where the columns are, and what a cycle and a flit of the machine are.
struct Columns {
    id: Option<usize>,
    at: (usize, At),
    from: usize,
    to: usize,
    length: (usize, Length),
}

#[derive(Clone, Copy)]
enum At {
    Cycle(Duration),
    Time,
}

#[derive(Clone, Copy)]
enum Length {
    Bytes,
    Flits(u64),
}

impl Columns {
    fn of(header: &StringRecord, links: Option<&LinkParameters>) -> Result<Columns, String> {
        for (place, name) in header.iter().enumerate() {
            if !COLUMNS.contains(&name) {
                let known = COLUMNS.map(str::to_owned);
                return Err(config::unknown("column", name, &known));
            }
            if header.iter().take(place).any(|earlier| earlier == name) {
                return Err(format!("found the column \"{name}\" twice; expected it once"));
            }
        }
        let find = |name: &str| header.iter().position(|other| other == name);
        let either = |one: &str, other: &str| match (find(one), find(other)) {
            (Some(place), None) => Ok((place, true)),
            (None, Some(place)) => Ok((place, false)),
            _ => Err(format!("expected a column \"{one}\" or \"{other}\", one of them")),
        };
        let needed = |name: &str| find(name).ok_or_else(|| format!("no column \"{name}\""));
        let (at, cycles) = either("cycle", "time")?;
        let (length, flits) = either("flits", "bytes")?;
        let links_for = |name: &str| {
            links.ok_or_else(|| {
                format!("found \"{name}\"; expected a machine whose file has \"network.links\"")
            })
        };
        Ok(Columns {
            id: find("id"),
            at: (at, if cycles { At::Cycle(links_for("cycle")?.cycle()) } else { At::Time }),
            from: needed("source")?,
            to: needed("destination")?,
            length: match flits {
                true => (length, Length::Flits(links_for("flits")?.flit_bytes)),
                false => (length, Length::Bytes),
            },
        })
    }

    /// The message of a line.
    fn message(
        &self,
        record: &StringRecord,
        index: usize,
        nodes: usize,
    ) -> Result<TraceMessage, String> {
        let node = |column: usize, name: &str| {
            let node = whole(record, column, name, nodes as u64 - 1)?;
            Ok::<_, String>(node as usize)
        };
        let latest = Duration::from_seconds_f64(LATEST);
        let at = match self.at {
            (column, At::Cycle(cycle)) => {
                cycle * whole(record, column, "cycle", latest.0 / cycle.0)?
            }
            (column, At::Time) => {
                let time = Quantity::<config::Time>::parse(&record[column]);
                let time = time.map_err(|message| format!("time: {message}"))?.value();
                if time > LATEST {
                    return Err(format!("time: found {time} s; expected at most {LATEST} s"));
                }
                Duration::from_seconds_f64(time)
            }
        };
        let bytes = match self.length {
            (column, Length::Bytes) => whole(record, column, "bytes", MOST_BYTES)?,
            (column, Length::Flits(bytes)) => {
                bytes * whole(record, column, "flits", MOST_BYTES / bytes)?
            }
        };
        let name = self.id.map_or_else(|| index.to_string(), |column| record[column].to_owned());
        check_name(&name).map_err(|message| format!("id: {message}"))?;
        let (from, to) = (node(self.from, "source")?, node(self.to, "destination")?);
        Ok(TraceMessage { name, at: Time::ZERO + at, from, to, bytes, after: Vec::new() })
    }
}

/// A whole number of a line.
fn whole(record: &StringRecord, column: usize, name: &str, most: u64) -> Result<u64, String> {
    let text = &record[column];
    let number = text.parse().ok().filter(|&number: &u64| number <= most);
    number.ok_or_else(|| format!("{name}: found \"{text}\"; expected a whole number, 0 to {most}"))
}
