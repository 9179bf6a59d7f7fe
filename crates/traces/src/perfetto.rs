//! A run as a Perfetto trace.

use desim::{Duration, Time};
use virtwall::{Activity, EnergyAt, MessageRecord, Recording};

use crate::activities::{activities, name, number};
use crate::packets::{Packets, Sequence, field};
use crate::protobuf::Fields;
use crate::sample::Sample;
use crate::track::{Event, Track};

const BEGIN: u64 = 1;
const END: u64 = 2;
const INSTANT: u64 = 3;
const COUNTER: u64 = 4;

/// The children of a track are ordered by rank.
const BY_RANK: u64 = 3;

/// The track that holds all others.
const RUN: u64 = 1;

const CATEGORIES: [&str; 3] = ["compute", "overhead", "paging"];

#[derive(Clone, Copy)]
enum Note {
    Bytes,
    BlockedNs,
    Environment,
    SourceEnvironment,
    Patch,
}

/// The names of annotations.
const NOTES: [&str; 5] = ["bytes", "blocked_ns", "environment", "source_environment", "patch"];

pub(crate) fn encode(recording: &Recording, title: &str, sample: Sample) -> Vec<u8> {
    let mut packets = Packets::default();
    let ordered = |track: &mut Fields| track.number(field::TRACK_CHILD_ORDERING, BY_RANK);
    packets.track((RUN, 0), &sample.caption(title), ordered);
    power(&mut packets, 2, "unshot power", recording, |energy| energy.unshot);
    power(&mut packets, 3, "power in transit", recording, |energy| energy.in_transit);
    Track::all(recording, sample).for_each(|node| write_track(&mut packets, &node));
    packets.finish()
}

/// A node's track, and below it the length of its queue.
fn write_track(packets: &mut Packets, node: &Track) {
    let rank = node.rank as u64;
    let track = 10 + 2 * rank;
    packets.track((track, RUN), &node.name(), |track| track.number(field::TRACK_RANK, rank + 10));
    let mut sequence = packets.sequence(track, intern);
    let mut shots = node.node.shots.iter().peekable();
    for (time, kind) in node.events(false) {
        packets.event(&mut sequence, time, |event| match kind {
            Event::End => event.number(field::EVENT_TYPE, END),
            Event::Begin(activity, numbers) => {
                begin(event, activity);
                let numbers = numbers.iter().filter(|&&number| node.sample.holds(number));
                match activity {
                    Activity::LocalShot | Activity::ReceivedShot => {
                        // A wall patch shoots all its directions at once: the first one represents them.
                        while shots.next_if(|shot| shot.at <= time).is_some() {}
                        if let Some(shot) = shots.peek() {
                            note(event, Note::Environment, shot.environment.into());
                            note(event, Note::SourceEnvironment, shot.source_environment.into());
                            note(event, Note::Patch, shot.patch.into());
                        }
                    }
                    Activity::Send(_) => numbers.for_each(|&n| depart(event, node.messages, n)),
                    _ => numbers.for_each(|&n| event.fixed(field::EVENT_LAST_FLOW, n as u64)),
                }
            }
            Event::Sent(number) => {
                event.number(field::EVENT_TYPE, INSTANT);
                let kind = node.messages[number].kind;
                event.number(field::EVENT_NAME, name_id(Activity::Send(kind)));
                depart(event, node.messages, number);
            }
            Event::Read(number) => {
                event.number(field::EVENT_TYPE, INSTANT);
                event.number(field::EVENT_NAME, name_id(Activity::Receive));
                event.fixed(field::EVENT_LAST_FLOW, number as u64);
            }
        });
    }
    write_queue(packets, &sequence, node);
}

fn write_queue(packets: &mut Packets, parent: &Sequence, node: &Track) {
    let changes = node.node.queue.iter().enumerate();
    let mut changes = changes.filter(|&(i, _)| node.sample.holds(i)).peekable();
    if changes.peek().is_none() {
        return;
    }
    let track = parent.track + 1;
    packets.track((track, parent.track), "queue", |track| counter(track, "sources"));
    let mut sequence = packets.sequence(track, |_| ());
    for (_, &(time, length)) in changes {
        packets.event(&mut sequence, time, |event| {
            event.number(field::EVENT_TYPE, COUNTER);
            event.number(field::EVENT_COUNTER_VALUE, length.into());
        });
    }
}

/// A counter of a power of the whole run, W.
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
        // Single precision is precise enough, and half as long when compressed.
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

/// A message is sent: its annotations, and the beginning of its arrow.
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

/// The number of an activity's name; 0 means no name.
fn name_id(activity: Activity) -> u64 {
    number(activity) as u64 + 1
}

/// Names that the events of a track refer to by number.
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
    for (id, note) in (1..).zip(NOTES) {
        entry(field::INTERNED_ANNOTATIONS, id, note);
    }
}
