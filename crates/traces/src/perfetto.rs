//! A run as a Perfetto trace.

use desim::{Duration, Time};
use virtwall::{Activity, EnergyAt, MessageRecord, Recording};

use crate::activities::{activities, name, number};
use crate::lane::{Lane, Mail, Mark};
use crate::packets::{Packets, Sequence, field};
use crate::protobuf::Fields;
use crate::sample::Sample;

/// Types of events.
const BEGIN: u64 = 1;
const END: u64 = 2;
const INSTANT: u64 = 3;
const COUNTER: u64 = 4;

/// The children of a track stand in the order of their ranks.
const BY_RANK: u64 = 3;

/// The track that holds all others.
const RUN: u64 = 1;

/// The categories that an activity can belong to.
const CATEGORIES: [&str; 3] = ["compute", "overhead", "paging"];

/// What is said of an event besides its name.
#[derive(Clone, Copy)]
enum Note {
    Bytes,
    BlockedNs,
    Environment,
    SourceEnvironment,
    Patch,
}

impl Note {
    const ALL: [(Note, &str); 5] = [
        (Note::Bytes, "bytes"),
        (Note::BlockedNs, "blocked_ns"),
        (Note::Environment, "environment"),
        (Note::SourceEnvironment, "source_environment"),
        (Note::Patch, "patch"),
    ];
}

/// The file's bytes.
pub(crate) fn encode(recording: &Recording, title: &str, sample: Sample) -> Vec<u8> {
    let mut packets = Packets::default();
    let ordered = |track: &mut Fields| track.number(field::TRACK_CHILD_ORDERING, BY_RANK);
    packets.track((RUN, 0), &sample.caption(title), ordered);
    power(&mut packets, 2, "unshot power", recording, |energy| energy.unshot);
    power(&mut packets, 3, "power in transit", recording, |energy| energy.in_transit);
    for (rank, mail) in Mail::of(recording).iter().enumerate() {
        let node = &recording.nodes[rank];
        let lane = Lane { messages: &recording.messages, node, mail, sample };
        write_lane(&mut packets, rank, &lane, rank + 1 == recording.nodes.len());
    }
    packets.finish()
}

/// A node's lane, and below it the length of its queue.
fn write_lane(packets: &mut Packets, rank: usize, lane: &Lane, is_service_node: bool) {
    let track = 10 + 2 * rank as u64;
    let name = if is_service_node { "service node".to_owned() } else { format!("node {rank}") };
    packets.track((track, RUN), &name, |track| track.number(field::TRACK_RANK, rank as u64 + 10));
    let mut sequence = packets.sequence(track, intern);
    let mut shots = lane.node.shots.iter();
    for (time, mark) in lane.marks(false) {
        packets.event(&mut sequence, time, |event| match mark {
            Mark::End => event.number(field::EVENT_TYPE, END),
            Mark::Begin(activity, numbers) => {
                begin(event, activity);
                let numbers = numbers.iter().filter(|&&number| lane.sample.holds(number));
                match activity {
                    Activity::LocalShot | Activity::ReceivedShot => {
                        if let Some(shot) = shots.next() {
                            note(event, Note::Environment, shot.environment.into());
                            note(event, Note::SourceEnvironment, shot.source_environment.into());
                            note(event, Note::Patch, shot.patch.into());
                        }
                    }
                    Activity::Send(_) => numbers.for_each(|&n| depart(event, lane.messages, n)),
                    _ => numbers.for_each(|&n| event.fixed(field::EVENT_LAST_FLOW, n as u64)),
                }
            }
            Mark::Sent(number) => {
                event.number(field::EVENT_TYPE, INSTANT);
                let kind = lane.messages[number].kind;
                event.number(field::EVENT_NAME, name_id(Activity::Send(kind)));
                depart(event, lane.messages, number);
            }
            Mark::Read(number) => {
                event.number(field::EVENT_TYPE, INSTANT);
                event.number(field::EVENT_NAME, name_id(Activity::Receive));
                event.fixed(field::EVENT_LAST_FLOW, number as u64);
            }
        });
    }
    write_queue(packets, &sequence, lane);
}

fn write_queue(packets: &mut Packets, parent: &Sequence, lane: &Lane) {
    let changes = lane.node.queue.iter().enumerate();
    let mut changes = changes.filter(|&(i, _)| lane.sample.holds(i)).peekable();
    if changes.peek().is_none() {
        return;
    }
    let track = parent.track() + 1;
    packets.track((track, parent.track()), "queue", |track| counter(track, "sources"));
    let mut sequence = packets.sequence(track, |_| ());
    for (_, &(time, length)) in changes {
        packets.event(&mut sequence, time, |event| {
            event.number(field::EVENT_TYPE, COUNTER);
            event.number(field::EVENT_COUNTER_VALUE, length.into());
        });
    }
}

/// A power of the whole run, W, where it changes.
fn power(
    packets: &mut Packets,
    track: u64,
    name: &str,
    recording: &Recording,
    of: impl Fn(&EnergyAt) -> f64,
) {
    packets.track((track, RUN), name, |fields| {
        fields.number(field::TRACK_RANK, track);
        counter(fields, "W");
    });
    let mut sequence = packets.sequence(track, |_| ());
    let mut last = None;
    for energy in &recording.energy {
        // Single precision is more than is seen, and half as long when deflated.
        let value = f64::from(of(energy) as f32);
        if last.replace(value) != Some(value) {
            packets.event(&mut sequence, energy.at, |event| {
                event.number(field::EVENT_TYPE, COUNTER);
                event.double(field::EVENT_COUNTER_DOUBLE, value);
            });
        }
    }
}

fn counter(track: &mut Fields, unit: &str) {
    track.message(field::TRACK_COUNTER, |counter| {
        counter.bytes(field::COUNTER_UNIT_NAME, unit.as_bytes());
    });
}

fn begin(event: &mut Fields, activity: Activity) {
    event.number(field::EVENT_TYPE, BEGIN);
    event.number(field::EVENT_NAME, name_id(activity));
    let category = match activity {
        _ if activity.computes() => 1,
        _ if activity.is_overhead() => 2,
        _ => 3,
    };
    event.number(field::EVENT_CATEGORY, category);
}

/// A message begins its way.
fn depart(event: &mut Fields, messages: &[MessageRecord], number: usize) {
    let message = &messages[number];
    note(event, Note::Bytes, message.bytes.into());
    if message.blocked > Duration::ZERO {
        note(event, Note::BlockedNs, (Time::ZERO + message.blocked).0 / 1_000);
    }
    event.fixed(field::EVENT_FLOW, number as u64);
}

fn note(event: &mut Fields, note: Note, value: u64) {
    event.message(field::EVENT_ANNOTATION, |annotation| {
        annotation.number(field::ANNOTATION_NAME, note as u64 + 1);
        annotation.number(field::ANNOTATION_NUMBER, value);
    });
}

/// The number of an activity's name; 0 is none's.
fn name_id(activity: Activity) -> u64 {
    number(activity) as u64 + 1
}

/// Names that the events of a lane have in common.
fn intern(data: &mut Fields) {
    let mut entry = |kind: u32, id: u64, name: &str| {
        data.message(kind, |entry| {
            entry.number(field::ENTRY_ID, id);
            entry.bytes(field::ENTRY_NAME, name.as_bytes());
        });
    };
    for activity in activities() {
        entry(field::INTERNED_NAMES, name_id(activity), &name(activity));
    }
    for (id, category) in (1..).zip(CATEGORIES) {
        entry(field::INTERNED_CATEGORIES, id, category);
    }
    for (note, name) in Note::ALL {
        entry(field::INTERNED_ANNOTATIONS, note as u64 + 1, name);
    }
}
