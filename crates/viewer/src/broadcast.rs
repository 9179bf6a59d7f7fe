//! Packs a run in parts while it is under way. `assets/data/live-run.js` reads them.

use std::collections::BTreeMap;

use desim::Time;
use multicomputer::{Rank, Stall};
use radiosity::{Rgb, Shot};
use virtwall::{Activity, Observer, Problem, SentMessage, ShotKey, Source, Span};

use crate::pack::{
    Columns, Emitters, MessageRow, fine_unit, message_columns, nanoseconds, shot_columns,
};
use crate::record::{NodeState, RecordedShot};

/// Receives the parts of a run. Called on the thread that simulates, which waits for the answer.
pub trait Subscriber {
    /// Whether another part is due; asked after every shot.
    fn is_due(&mut self) -> bool;

    /// A part of the run: what happened since the part before it.
    fn receive(&mut self, part: String);
}

/// An observer that passes a run on in parts. Of what it has passed on it keeps only which shots and
/// emitters the page knows.
pub struct Broadcast {
    subscriber: Box<dyn Subscriber>,
    /// The unit of form factors.
    unit: f64,
    now: Time,
    /// By rank.
    nodes: Vec<Node>,
    known_shots: BTreeMap<ShotKey, u64>,
    emitters: Emitters,
    under_way: BTreeMap<u64, (Time, SentMessage)>,
    /// What happened since the last part, besides spans. Of shots the rank, their number, that of the
    /// emitter, the length of the queue and the bytes of memory.
    shots: Vec<[u64; 5]>,
    hits: Vec<RecordedShot>,
    messages: Vec<MessageRow>,
}

#[derive(Clone, Default)]
struct Node {
    /// What it did since the last part, without waiting.
    spans: Vec<Span>,
    /// The end of the last span that was passed on, nanoseconds.
    passed_on: u64,
    /// What it has selected and not shot yet, and since when.
    selected: Option<(NodeState, Time)>,
    /// The time in kernels so far for what it has selected.
    shooting: Option<Span>,
    queue: u64,
    /// The length of its queue when it selected.
    queue_left: u64,
    /// Bytes.
    memory: u64,
}

impl Broadcast {
    /// Broadcasts a run on `processors` compute nodes to `subscriber`.
    pub fn new(
        problem: &Problem,
        processors: usize,
        subscriber: impl Subscriber + 'static,
    ) -> Broadcast {
        Broadcast {
            subscriber: Box::new(subscriber),
            unit: fine_unit(problem),
            now: Time::ZERO,
            nodes: vec![Node::default(); processors + 1],
            known_shots: BTreeMap::new(),
            emitters: Emitters::default(),
            under_way: BTreeMap::new(),
            shots: Vec::new(),
            hits: Vec::new(),
            messages: Vec::new(),
        }
    }

    /// Passes on what has not been passed on yet.
    pub fn flush(&mut self) {
        let part = self.part().pack();
        self.subscriber.receive(part);
    }

    fn part(&mut self) -> Columns {
        let mut columns = Columns::default();
        columns.ints([nanoseconds(self.now)]);
        self.span_columns(&mut columns);
        let shots = std::mem::take(&mut self.shots);
        for field in 0..5 {
            columns.ints(shots.iter().map(|shot| shot[field]));
        }
        self.emitters.columns(&mut columns);
        let hits = std::mem::take(&mut self.hits);
        shot_columns(&hits.iter().collect::<Vec<_>>(), self.unit, &mut columns);
        message_columns(&std::mem::take(&mut self.messages), &mut columns);
        columns
    }

    /// What nodes did since the last part, and what they do now: the state's number plus 1, or 0 where
    /// they wait.
    fn span_columns(&mut self, columns: &mut Columns) {
        let (mut gaps, mut lengths, mut states) = (Vec::new(), Vec::new(), Vec::new());
        columns.ints(self.nodes.iter().map(|node| node.spans.len() as u64));
        for node in &mut self.nodes {
            for span in std::mem::take(&mut node.spans) {
                let (from, to) = (nanoseconds(span.from), nanoseconds(span.to));
                gaps.push(from.saturating_sub(node.passed_on));
                lengths.push(to - from);
                states.push(NodeState::of(span.activity) as u64);
                node.passed_on = to;
            }
        }
        columns.ints(states);
        columns.ints(gaps);
        columns.ints(lengths);
        let selected = self.nodes.iter().map(|node| node.selected);
        let selected =
            selected.map(|of| of.map_or((0, 0), |(state, at)| (state as u64 + 1, nanoseconds(at))));
        columns.ints(selected.clone().map(|(state, _)| state));
        columns.ints(selected.map(|(_, since)| since));
    }
}

impl Observer for Broadcast {
    fn activity(&mut self, rank: Rank, activity: Activity, from: Time, to: Time) {
        // The run's time is that of its compute nodes.
        if rank + 1 < self.nodes.len() {
            self.now = self.now.max(to);
        }
        let node = &mut self.nodes[rank];
        match activity {
            // Passed on when all kernels of the shot have run.
            Activity::LocalShot | Activity::ReceivedShot => {
                let from = node.shooting.map_or(from, |earlier| earlier.from);
                node.shooting = Some(Span { activity, from, to });
            }
            Activity::Wait => {}
            _ if nanoseconds(to) > nanoseconds(from) => {
                node.spans.push(Span { activity, from, to });
            }
            _ => {}
        }
    }

    fn sent(&mut self, now: Time, message: &SentMessage) {
        self.under_way.insert(message.number, (now, *message));
    }

    fn arrived(&mut self, now: Time, number: u64, _: &[Stall]) {
        let Some((sent, message)) = self.under_way.remove(&number) else { return };
        let SentMessage { from, to, kind, bytes, .. } = message;
        let times = [sent, now].map(nanoseconds);
        self.messages.push([times[0], times[1], from as u64, to as u64, kind as u64, bytes]);
    }

    fn selected(&mut self, now: Time, rank: Rank, source: &Source) {
        let node = &mut self.nodes[rank];
        node.selected = Some((NodeState::of(activity_of(source)), now));
        node.queue_left = node.queue;
    }

    fn shot(&mut self, now: Time, rank: Rank, source: &Source, shot: &Shot, _: Rgb) {
        self.now = self.now.max(now);
        let node = &mut self.nodes[rank];
        // Kernels that take no time leave no span.
        let instant = Span { activity: activity_of(source), from: now, to: now };
        node.spans.push(node.shooting.take().unwrap_or(instant));
        node.selected = None;
        let shot = RecordedShot::of(source, shot);
        let next = self.known_shots.len() as u64;
        let number = *self.known_shots.entry(shot.key).or_insert(next);
        let emitter = self.emitters.number(shot.emitter, shot.power);
        self.shots.push([rank as u64, number, emitter, node.queue_left, node.memory]);
        if number == next {
            self.hits.push(shot);
        }
        if self.subscriber.is_due() {
            self.flush();
        }
    }

    fn queue(&mut self, _: Time, rank: Rank, length: usize) {
        self.nodes[rank].queue = length as u64;
    }

    fn memory(&mut self, _: Time, rank: Rank, bytes: u64) {
        self.nodes[rank].memory = bytes;
    }
}

fn activity_of(source: &Source) -> Activity {
    if source.is_local() { Activity::LocalShot } else { Activity::ReceivedShot }
}
