//! Pajé traces, read by pj_dump where it is installed (Debian's pajeng), and line by line.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use std::collections::BTreeMap;
use std::io::Write as _;
use std::process::{Command, Stdio};

use common::{PROCESSORS, paragon, record};
use desim::Duration;
use traces::{Format, Sample};
use virtwall::{Activity, MessageKind, NodeRecord, Outcome, Recording};

/// A run, and its trace's text.
fn trace(sample: Sample) -> (Outcome, Recording, String) {
    let machine = paragon();
    let (outcome, recording) = record(&machine, machine.network());
    let text = String::from_utf8(Format::Paje.encode(&recording, "a \"test\"", sample)).unwrap();
    (outcome, recording, text)
}

/// The cells that pj_dump prints of a trace; none where it is not installed.
fn pj_dump(text: &str) -> Option<Vec<Vec<String>>> {
    let mut command = Command::new("pj_dump");
    command.args(["--user-defined", "--float-precision=9"]);
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut process = match command.spawn() {
        Ok(process) => process,
        Err(error) => {
            eprintln!("not compared with pj_dump, of Debian's pajeng: {error}");
            return None;
        }
    };
    let (mut input, text) = (process.stdin.take().unwrap(), text.to_owned());
    let writer = std::thread::spawn(move || input.write_all(text.as_bytes()).unwrap());
    let output = process.wait_with_output().unwrap();
    writer.join().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success() && said.is_empty(), "{said}");
    let lines = String::from_utf8(output.stdout).unwrap();
    let cells = |line: &str| line.split(", ").map(str::to_owned).collect();
    Some(lines.lines().map(cells).collect())
}

/// pj_dump finds the messages, the bytes and the busy times that the run counted.
#[test]
fn pj_dump_reads_what_the_run_counted() {
    let (outcome, recording, text) = trace(Sample::ALL);
    let Some(rows) = pj_dump(&text) else { return };
    let links = |kind: MessageKind| -> (u64, u64) {
        let links = rows.iter().filter(|row| row[0] == "Link" && row[6] == kind.name());
        links.fold((0, 0), |(n, bytes), row| (n + 1, bytes + row[10].parse::<u64>().unwrap()))
    };
    let counts = outcome.counts;
    assert_eq!(links(MessageKind::Source), (counts.messages, counts.message_bytes));
    assert_eq!(links(MessageKind::Update), (counts.update_messages, counts.update_bytes));
    let all: u64 = MessageKind::all().map(|kind| links(kind).0).sum();
    assert_eq!(all, recording.messages.len() as u64);
    for (rank, report) in outcome.nodes.iter().enumerate() {
        let node = format!("node {rank}");
        let states = rows.iter().filter(|row| row[0] == "State" && row[1] == node);
        let mut found: BTreeMap<&str, f64> = BTreeMap::new();
        states.for_each(|row| *found.entry(&row[7]).or_default() += row[5].parse::<f64>().unwrap());
        let time = |activities: &[&str]| -> f64 {
            activities.iter().filter_map(|name| found.get(name)).sum()
        };
        let spans = recording.nodes[rank].spans().count() as f64;
        let close = |found: f64, exact: Duration| {
            assert!((found - exact.as_seconds_f64()).abs() < 2e-9 * spans, "{found} {exact}");
        };
        close(time(&["selection", "local shot", "received shot"]), report.compute);
        close(time(&["wait"]), report.idle);
        let messages: Vec<String> =
            MessageKind::all().map(|kind| format!("send {}", kind.name())).collect();
        let mut overheads: Vec<&str> = messages.iter().map(String::as_str).collect();
        overheads.push("receive");
        close(time(&overheads), report.overhead);
    }
    let queues = rows.iter().filter(|row| row[0] == "Variable" && row[2] == "Queue length");
    assert!(queues.count() > 0);
}

/// Lines stand in the order of time, arrows end where they were read.
#[test]
fn lines_are_in_order() {
    let (_, recording, text) = trace(Sample::ALL);
    let events: Vec<Vec<&str>> = text
        .lines()
        .filter(|line| !line.starts_with('%'))
        .map(|l| l.split(' ').collect())
        .collect();
    let timed = events.iter().filter(|event| ["5", "6", "7", "8"].contains(&event[0]));
    let times: Vec<f64> = timed.map(|event| event[1].parse().unwrap()).collect();
    assert!(times.is_sorted());
    let states = events.iter().filter(|event| event[0] == "5").count();
    let changes = |node: &NodeRecord| {
        let mut activities: Vec<Activity> = node.spans().map(|span| span.activity).collect();
        activities.dedup();
        activities.len()
    };
    let changes: usize = recording.nodes.iter().map(changes).sum();
    assert_eq!(states, changes + PROCESSORS + 1);
    let (starts, ends): (Vec<_>, Vec<_>) =
        events.iter().filter(|e| ["7", "8"].contains(&e[0])).partition(|event| event[0] == "7");
    assert_eq!((starts.len(), ends.len()), (recording.messages.len(), recording.messages.len()));
    // Those that are sent at one time stand in the order of their numbers.
    let mut messages: Vec<_> = recording.messages.iter().collect();
    messages.sort_by_key(|message| message.sent);
    for (start, message) in starts.iter().zip(messages) {
        assert_eq!(start[5], (message.from + 2).to_string());
        assert_eq!(start[7], message.bytes.to_string());
        let end = ends.iter().find(|end| end[6] == start[6]).unwrap();
        assert_eq!(end[5], (message.to + 2).to_string());
    }
}

/// The size of the arrow of a message; states are not counted.
#[test]
fn a_message_takes_at_most_64_bytes() {
    let (_, recording, text) = trace(Sample::ALL);
    let arrows = text.lines().filter(|line| line.starts_with("7 ") || line.starts_with("8 "));
    let bytes: usize = arrows.map(|line| line.len() + 1).sum();
    assert!(bytes <= 64 * recording.messages.len(), "{bytes}");
}

#[test]
fn a_sample_is_sound() {
    let (_, recording, text) = trace(Sample::one_in(7));
    assert!(text.contains("\"a 'test', one message in 7\""), "{text}");
    let arrows = text.lines().filter(|line| line.starts_with("7 ")).count();
    assert_eq!(arrows, recording.messages.len().div_ceil(7));
    let kernels = |span: &virtwall::Span| span.activity == Activity::LocalShot;
    let shots = recording.nodes.iter().flat_map(|node| node.spans()).filter(kernels).count();
    let shown = text.lines().filter(|l| l.starts_with("5 ") && l.ends_with(" b")).count();
    assert_eq!(shown, shots);
    pj_dump(&text);
}
