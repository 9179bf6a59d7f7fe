//! The block of one run: what each node did, its messages, its critical path.

use std::collections::BTreeMap;

use desim::Time;
use radiosity::Rgb;
use virtwall::{Activity, NodeRecord, Recording, ShotRecord, Span};

use crate::columns::Columns;
use crate::critical::Link;
use crate::film::{Doing, Film};
use crate::scene::Shots;

/// Nanoseconds: the page's unit of time.
pub(crate) fn ns(time: Time) -> u64 {
    (time.0 + 500) / 1000
}

/// All of a run, with `every`th message from the first on.
pub(crate) fn columns(
    film: &Film,
    owners: &[usize],
    shots: &Shots,
    path: &[Link],
    every: usize,
) -> Columns {
    let mut columns = Columns::default();
    columns.ints(owners.iter().map(|&owner| owner as u64));
    spans(film, shots, &mut columns);
    messages(&film.recording, every, &mut columns);
    columns.ints(path.iter().map(|link| link.node as u64));
    columns.ints(path.iter().map(|link| ns(link.from)));
    columns.ints(path.iter().map(|link| ns(link.to) - ns(link.from)));
    columns.ints(path.iter().map(|link| link.doing as u64));
    columns
}

fn spans(film: &Film, shots: &Shots, columns: &mut Columns) {
    let nodes: Vec<Vec<Span>> = film.recording.nodes.iter().map(told).collect();
    columns.ints(nodes.iter().map(|spans| spans.len() as u64));
    let spans = || nodes.iter().flatten();
    columns.ints(spans().map(|span| Doing::of(span.activity) as u64));
    columns.ints(nodes.iter().flat_map(|spans| {
        let ends = [0].into_iter().chain(spans.iter().map(|span| ns(span.to)));
        spans.iter().zip(ends).map(|(span, end)| ns(span.from) - end)
    }));
    columns.ints(spans().map(|span| ns(span.to) - ns(span.from)));

    let beams = || film.beams.iter().flatten();
    columns.steps(beams().map(|beam| shots.number(beam) as i64));
    let mut known = BTreeMap::new();
    let mut sources: Vec<((u32, u32), Rgb)> = Vec::new();
    columns.steps(beams().map(|beam| {
        let power = beam.power.to_array().map(f64::to_bits);
        *known.entry((beam.source, power)).or_insert_with(|| {
            sources.push((beam.source, beam.power));
            sources.len() as i64 - 1
        })
    }));
    let shots = |node: usize| nodes[node].iter().filter(|span| is_shot(span.activity));
    let ranks = || 0..nodes.len();
    columns.ints(ranks().flat_map(|node| {
        let queue = &film.recording.nodes[node].queue;
        shots(node).map(|span| last(queue, span.from).map_or(0, u64::from))
    }));
    let modelled = film.memory.iter().any(|node| !node.is_empty());
    columns.ints(ranks().filter(|_| modelled).flat_map(|node| {
        shots(node).map(move |span| last(&film.memory[node], span.from).unwrap_or(0))
    }));
    columns.ints(sources.iter().map(|((environment, _), _)| u64::from(*environment)));
    columns.ints(sources.iter().map(|((_, patch), _)| u64::from(*patch)));
    columns.floats(sources.iter().flat_map(|(_, power)| power.to_array()));
}

fn is_shot(activity: Activity) -> bool {
    matches!(activity, Activity::LocalShot | Activity::ReceivedShot)
}

/// What a node did but for waiting, with exactly one span a shot, be it without length.
pub(crate) fn told(node: &NodeRecord) -> Vec<Span> {
    let mut shots = node.shots.iter().peekable();
    let mut told = Vec::new();
    let mut begun = None;
    for mut span in node.spans() {
        // Kernels that take no time leave no span.
        while let Some(shot) = shots.next_if(|shot| shot.at <= span.from) {
            told.push(instant(shot));
        }
        if is_shot(span.activity) {
            span.from = begun.take().unwrap_or(span.from);
            // What caches miss is a kernel's time that follows it.
            if shots.peek().is_some_and(|shot| shot.at > span.to) {
                begun = Some(span.from);
                continue;
            }
            shots.next();
        }
        if span.activity != Activity::Wait
            && (is_shot(span.activity) || ns(span.to) > ns(span.from))
        {
            told.push(span);
        }
    }
    told.extend(shots.map(instant));
    told
}

/// A shot that took no time.
fn instant(shot: &ShotRecord) -> Span {
    let local = shot.environment == shot.source_environment;
    let activity = if local { Activity::LocalShot } else { Activity::ReceivedShot };
    Span { activity, from: shot.at, to: shot.at }
}

/// What a course was at a time.
fn last<T: Copy>(course: &[(Time, T)], time: Time) -> Option<T> {
    let known = course.partition_point(|(at, _)| *at <= time);
    course[..known].last().map(|&(_, value)| value)
}

fn messages(recording: &Recording, every: usize, columns: &mut Columns) {
    let messages = || recording.messages.iter().step_by(every);
    columns.steps(messages().map(|message| ns(message.sent) as i64));
    columns.ints(messages().map(|m| ns(m.arrived.unwrap_or(m.sent)) - ns(m.sent)));
    columns.ints(messages().map(|message| u64::from(message.from)));
    columns.ints(messages().map(|message| u64::from(message.to)));
    columns.ints(messages().map(|message| message.kind as u64));
    columns.ints(messages().map(|message| u64::from(message.bytes)));
}
