//! The block of a run: what each node did when, its messages, its critical path.

use desim::Time;
use virtwall::{Activity, NodeRecord, Recording, ShotRecord, Span};

use super::shots::Shots;
use super::{Columns, Emitters};
use crate::explain::PathSegment;
use crate::record::{LightRecording, NodeState, is_shot};

/// The page's unit of time.
pub(crate) fn nanoseconds(time: Time) -> u64 {
    (time.0 + 500) / 1000
}

/// The columns of a run, with the first and then every `every`th message.
pub(super) fn run_columns(
    recording: &LightRecording,
    owners: &[usize],
    shots: &Shots,
    path: &[PathSegment],
    every: usize,
) -> Columns {
    let mut columns = Columns::default();
    columns.ints(owners.iter().map(|&owner| owner as u64));
    span_columns(recording, shots, &mut columns);
    message_columns(&messages(&recording.recording, every), &mut columns);
    columns.ints(path.iter().map(|segment| segment.node as u64));
    columns.ints(path.iter().map(|segment| nanoseconds(segment.from)));
    columns.ints(path.iter().map(|segment| nanoseconds(segment.to) - nanoseconds(segment.from)));
    columns.ints(path.iter().map(|segment| segment.state as u64));
    columns
}

fn span_columns(recording: &LightRecording, numbers: &Shots, columns: &mut Columns) {
    let nodes: Vec<Vec<Span>> = recording.recording.nodes.iter().map(shown_spans).collect();
    columns.ints(nodes.iter().map(|spans| spans.len() as u64));
    let spans = || nodes.iter().flatten();
    columns.ints(spans().map(|span| NodeState::of(span.activity) as u64));
    columns.ints(nodes.iter().flat_map(|spans| {
        let ends = [0].into_iter().chain(spans.iter().map(|span| nanoseconds(span.to)));
        spans.iter().zip(ends).map(|(span, end)| nanoseconds(span.from) - end)
    }));
    columns.ints(spans().map(|span| nanoseconds(span.to) - nanoseconds(span.from)));

    let shots = || recording.shots.iter().flatten();
    columns.deltas(shots().map(|shot| numbers.number(shot) as i64));
    let mut emitters = Emitters::default();
    columns.deltas(shots().map(|shot| emitters.number(shot.emitter, shot.power) as i64));
    let shot_spans = |node: usize| nodes[node].iter().filter(|span| is_shot(span.activity));
    let ranks = || 0..nodes.len();
    columns.ints(ranks().flat_map(|node| {
        let queue = &recording.recording.nodes[node].queue;
        shot_spans(node).map(|span| value_at(queue, span.from).map_or(0, u64::from))
    }));
    let modelled = recording.memory.iter().any(|node| !node.is_empty());
    columns.ints(ranks().filter(|_| modelled).flat_map(|node| {
        let memory = &recording.memory[node];
        shot_spans(node).map(move |span| value_at(memory, span.from).unwrap_or(0))
    }));
    emitters.columns(columns);
}

/// What a node did besides waiting, with exactly one span a shot, even if its length is zero.
pub(crate) fn shown_spans(node: &NodeRecord) -> Vec<Span> {
    let mut shots = node.shots.iter().peekable();
    let mut shown = Vec::new();
    let mut begun = None;
    for mut span in node.spans() {
        // Kernels that take no time leave no span.
        while let Some(shot) = shots.next_if(|shot| shot.at <= span.from) {
            shown.push(instant(shot));
        }
        if is_shot(span.activity) {
            span.from = begun.take().unwrap_or(span.from);
            // The time of cache misses is a second span that follows the kernel's.
            if shots.peek().is_some_and(|shot| shot.at > span.to) {
                begun = Some(span.from);
                continue;
            }
            shots.next();
        }
        if span.activity != Activity::Wait
            && (is_shot(span.activity) || nanoseconds(span.to) > nanoseconds(span.from))
        {
            shown.push(span);
        }
    }
    shown.extend(shots.map(instant));
    shown
}

/// A shot that took no time.
fn instant(shot: &ShotRecord) -> Span {
    let local = shot.environment == shot.source_environment;
    let activity = if local { Activity::LocalShot } else { Activity::ReceivedShot };
    Span { activity, from: shot.at, to: shot.at }
}

/// The value at a time of something whose changes are recorded.
fn value_at<T: Copy>(changes: &[(Time, T)], time: Time) -> Option<T> {
    let known = changes.partition_point(|(at, _)| *at <= time);
    changes[..known].last().map(|&(_, value)| value)
}

/// When a message was sent and arrived, nanoseconds; sender, receiver, kind and bytes.
pub(crate) type MessageRow = [u64; 6];

fn messages(recording: &Recording, every: usize) -> Vec<MessageRow> {
    let messages = recording.messages.iter().step_by(every).map(|message| {
        [
            nanoseconds(message.sent),
            nanoseconds(message.arrived.unwrap_or(message.sent)),
            message.from.into(),
            message.to.into(),
            message.kind as u64,
            message.bytes.into(),
        ]
    });
    messages.collect()
}

pub(crate) fn message_columns(messages: &[MessageRow], columns: &mut Columns) {
    columns.deltas(messages.iter().map(|&[sent, ..]| sent as i64));
    columns.ints(messages.iter().map(|&[sent, arrived, ..]| arrived - sent));
    for field in 2..6 {
        columns.ints(messages.iter().map(|message| message[field]));
    }
}
