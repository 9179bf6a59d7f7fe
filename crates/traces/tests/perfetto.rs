//! Perfetto traces, read by an independent decoder of protocol buffers: they show what the run counted.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;
mod reader;

use common::{PROCESSORS, paragon, record};
use multicomputer::{ContentionFree, Ideal, MessageLayer};
use reader::{Read, read};
use traces::{Format, Sample};
use virtwall::{Activity, MessageKind, Recording};

fn trace(recording: &Recording, sample: Sample) -> Read {
    read(&Format::Perfetto.encode(recording, "a test", sample))
}

fn node(rank: usize) -> String {
    if rank == PROCESSORS { "service node".to_owned() } else { format!("node {rank}") }
}

/// Whether times in ns agree, if each of `spans` was rounded by less than 1 ns.
fn close(found: u64, exact: desim::Duration, spans: usize) -> bool {
    found.abs_diff(exact.0 / 1_000) <= spans as u64
}

#[test]
fn spans_are_those_of_the_run() {
    let machine = paragon();
    let (outcome, recording) = record(&machine, machine.network());
    let read = trace(&recording, Sample::ALL);
    for (rank, report) in outcome.nodes.iter().enumerate() {
        let slices: Vec<_> = read.slices.iter().filter(|s| s.track == node(rank)).collect();
        let spans = recording.nodes[rank].spans().filter(|s| s.activity != Activity::Wait);
        assert_eq!(slices.len(), spans.count());
        let time = |wanted: &dyn Fn(&str) -> bool| -> u64 {
            slices.iter().filter(|s| wanted(&s.category)).map(|s| s.to - s.from).sum()
        };
        assert!(close(time(&|c| c == "compute"), report.compute, slices.len()));
        assert!(close(time(&|c| c == "overhead"), report.overhead, slices.len()));
        let count = |name: &str| slices.iter().filter(|s| s.name == name).count() as u64;
        assert_eq!(count("local shot"), report.local_shots);
        assert_eq!(count("received shot"), report.received_shots);
    }
    let end = read.slices.iter().map(|s| s.to).max().unwrap();
    assert!(end <= outcome.time.0 / 1_000 + 1_000_000_000);
}

/// Every message is sent once, with its bytes, and its arrow leads to where it was read.
#[test]
fn messages_are_those_of_the_run() {
    let plain = paragon();
    let mut coprocessor = paragon();
    coprocessor.message_layer = MessageLayer {
        handover: Some(desim::Duration::from_seconds_f64(1e-5)),
        ..MessageLayer::default()
    };
    let free = || Box::new(ContentionFree::new(Ideal));
    let runs = [
        record(&plain, plain.network()),
        record(&plain, free()),
        record(&coprocessor, coprocessor.network()),
    ];
    for (outcome, recording) in runs {
        let read = trace(&recording, Sample::ALL);
        let sent = |kind: MessageKind| {
            let name = format!("send {}", kind.name());
            read.departures.iter().filter(move |d| d.name == name)
        };
        let sources = sent(MessageKind::Source);
        assert_eq!(sources.clone().count() as u64, outcome.counts.messages);
        assert_eq!(sources.map(|d| d.bytes).sum::<u64>(), outcome.counts.message_bytes);
        let updates = sent(MessageKind::Update);
        assert_eq!(updates.clone().count() as u64, outcome.counts.update_messages);
        assert_eq!(updates.map(|d| d.bytes).sum::<u64>(), outcome.counts.update_bytes);
        assert_eq!(read.departures.len(), recording.messages.len());
        for departure in &read.departures {
            let message = recording.messages[departure.flow as usize];
            assert_eq!(departure.track, node(message.from as usize));
            assert_eq!(departure.at, message.sent.0 / 1_000);
            let arrivals: Vec<_> =
                read.arrivals.iter().filter(|a| a.flow == departure.flow).collect();
            assert_eq!(arrivals.len(), usize::from(message.read.is_some()));
            for arrival in arrivals {
                assert_eq!(arrival.track, node(message.to as usize));
                assert_eq!(Some(arrival.at), message.read.map(|time| time.0 / 1_000));
            }
        }
    }
}

#[test]
fn counters_are_those_of_the_run() {
    let machine = paragon();
    let (outcome, recording) = record(&machine, machine.network());
    let read = trace(&recording, Sample::ALL);
    let last = |track: &str| read.counters.iter().rfind(|c| c.track == track).unwrap().value;
    let unshot = outcome.energy.unshot.element_sum();
    assert!((last("unshot power") - unshot).abs() < 1e-6 * unshot);
    assert_eq!(last("power in transit").round(), 0.0);
    let queues = read.counters.iter().filter(|c| c.track.ends_with("/queue"));
    let changes: usize = recording.nodes.iter().map(|node| node.queue.len()).sum();
    assert!(changes > 0);
    assert_eq!(queues.count(), changes);
}

/// A sample shows fewer messages, all kernels, and says so.
#[test]
fn samples_leave_messages_out() {
    let machine = paragon();
    let (_, recording) = record(&machine, machine.network());
    let (all, some) = (trace(&recording, Sample::ALL), trace(&recording, Sample::one_in(10)));
    assert_eq!(some.departures.len(), recording.messages.len().div_ceil(10));
    assert!(some.departures.iter().all(|d| d.flow % 10 == 0));
    assert!(some.arrivals.iter().all(|a| a.flow % 10 == 0));
    let kernels = |read: &Read| read.slices.iter().filter(|s| s.category == "compute").count();
    assert_eq!(kernels(&some), kernels(&all));
    assert!(some.slices.len() < all.slices.len());
    assert!(some.tracks.contains(&"a test, one message in 10".to_owned()));
    assert!(all.tracks.contains(&"a test".to_owned()));
}

/// The size of the whole file.
#[test]
fn a_message_takes_at_most_64_bytes() {
    let machine = paragon();
    let (_, recording) = record(&machine, machine.network());
    let bytes = Format::Perfetto.encode(&recording, "a test", Sample::ALL).len();
    assert!(bytes <= 64 * recording.messages.len(), "{bytes} B, {}", recording.messages.len());
}
