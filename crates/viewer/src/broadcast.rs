//! A run while it is under way: what a page is told of it, part by part. Their reader is
//! `assets/live-run.js`.

use std::collections::BTreeMap;

use desim::Time;
use multicomputer::{Rank, Stall};
use radiosity::{Rgb, Shot};
use virtwall::{Activity, Observer, Problem, SentMessage, ShotKey, Source, Span};

use crate::columns::Columns;
use crate::film::{Beam, Doing};
use crate::run::ns;
use crate::scene::{beam_columns, fine_unit};

/// Who a run is broadcast to. Both are asked by the thread that simulates, and have to answer at once.
pub trait Audience {
    /// Whether it is time for another part; asked after every shot.
    fn is_due(&mut self) -> bool;

    /// A part of the run: what happened since the part before it.
    fn receive(&mut self, part: String);
}

/// An observer that tells of a run as it goes, and remembers nothing that was told but which shots and
/// sources the page knows.
pub struct Broadcast {
    audience: Box<dyn Audience>,
    /// The form factor that counts one.
    unit: f64,
    now: Time,
    /// By rank.
    lanes: Vec<Lane>,
    known_shots: BTreeMap<ShotKey, u64>,
    known_sources: BTreeMap<((u32, u32), [u64; 3]), u64>,
    under_way: BTreeMap<u64, (Time, SentMessage)>,
    news: News,
}

/// What a node is up to.
#[derive(Clone, Default)]
struct Lane {
    /// What it did since the last part, but for waiting.
    spans: Vec<Span>,
    /// The end of the last span that was told, nanoseconds.
    told: u64,
    /// What it has chosen and not shot yet, and since when.
    chosen: Option<(Doing, Time)>,
    /// The time in kernels for what it has chosen.
    shooting: Option<Span>,
    queue: u64,
    /// Of its queue, when it chose.
    queue_left: u64,
    memory: u64,
}

/// What happened since the last part, besides spans.
#[derive(Default)]
struct News {
    shots: Vec<ShotNews>,
    beams: Vec<Beam>,
    sources: Vec<((u32, u32), Rgb)>,
    /// Messages that have arrived: when they were sent, and when they came.
    messages: Vec<(Time, Time, SentMessage)>,
}

struct ShotNews {
    rank: Rank,
    number: u64,
    source: u64,
    queue: u64,
    memory: u64,
}

impl Broadcast {
    /// Of a run of a problem on so many processors.
    pub fn new(
        problem: &Problem,
        processors: usize,
        audience: impl Audience + 'static,
    ) -> Broadcast {
        Broadcast {
            audience: Box::new(audience),
            unit: fine_unit(problem),
            now: Time::ZERO,
            lanes: vec![Lane::default(); processors + 1],
            known_shots: BTreeMap::new(),
            known_sources: BTreeMap::new(),
            under_way: BTreeMap::new(),
            news: News::default(),
        }
    }

    /// Tells what has not been told yet.
    pub fn tell(&mut self) {
        let part = self.part().pack();
        self.audience.receive(part);
    }

    fn part(&mut self) -> Columns {
        let news = std::mem::take(&mut self.news);
        let mut columns = Columns::default();
        columns.ints([ns(self.now)]);
        self.spans(&mut columns);
        let shots = || news.shots.iter();
        columns.ints(shots().map(|shot| shot.rank as u64));
        columns.ints(shots().map(|shot| shot.number));
        columns.ints(shots().map(|shot| shot.source));
        columns.ints(shots().map(|shot| shot.queue));
        columns.ints(shots().map(|shot| shot.memory));
        columns.ints(news.sources.iter().map(|((environment, _), _)| u64::from(*environment)));
        columns.ints(news.sources.iter().map(|((_, patch), _)| u64::from(*patch)));
        columns.floats(news.sources.iter().flat_map(|(_, power)| power.to_array()));
        beam_columns(&news.beams.iter().collect::<Vec<_>>(), self.unit, &mut columns);
        let messages = || news.messages.iter();
        columns.steps(messages().map(|(sent, ..)| ns(*sent) as i64));
        columns.ints(messages().map(|(sent, arrived, _)| ns(*arrived) - ns(*sent)));
        columns.ints(messages().map(|(.., message)| message.from as u64));
        columns.ints(messages().map(|(.., message)| message.to as u64));
        columns.ints(messages().map(|(.., message)| message.kind as u64));
        columns.ints(messages().map(|(.., message)| message.bytes));
        columns
    }

    /// What nodes did since the last part, and what they are doing: 1 more than its number, or 0 where
    /// they wait.
    fn spans(&mut self, columns: &mut Columns) {
        let (mut gaps, mut lengths, mut kinds) = (Vec::new(), Vec::new(), Vec::new());
        columns.ints(self.lanes.iter().map(|lane| lane.spans.len() as u64));
        for lane in &mut self.lanes {
            for span in std::mem::take(&mut lane.spans) {
                gaps.push(ns(span.from).saturating_sub(lane.told));
                lengths.push(ns(span.to) - ns(span.from));
                kinds.push(Doing::of(span.activity) as u64);
                lane.told = ns(span.to);
            }
        }
        columns.ints(kinds);
        columns.ints(gaps);
        columns.ints(lengths);
        let chosen = || self.lanes.iter().map(|lane| lane.chosen);
        columns.ints(chosen().map(|chosen| chosen.map_or(0, |(doing, _)| doing as u64 + 1)));
        columns.ints(chosen().map(|chosen| chosen.map_or(0, |(_, since)| ns(since))));
    }
}

impl Observer for Broadcast {
    fn activity(&mut self, rank: Rank, activity: Activity, from: Time, to: Time) {
        // The run's time is that of its compute nodes.
        if rank + 1 < self.lanes.len() {
            self.now = self.now.max(to);
        }
        let lane = &mut self.lanes[rank];
        match activity {
            // With its shot, which is told of when all its kernels have run.
            Activity::LocalShot | Activity::ReceivedShot => {
                let from = lane.shooting.map_or(from, |earlier| earlier.from);
                lane.shooting = Some(Span { activity, from, to });
            }
            Activity::Wait => {}
            _ if ns(to) > ns(from) => lane.spans.push(Span { activity, from, to }),
            _ => {}
        }
    }

    fn sent(&mut self, now: Time, message: &SentMessage) {
        self.under_way.insert(message.number, (now, *message));
    }

    fn arrived(&mut self, now: Time, number: u64, _: &[Stall]) {
        let message = self.under_way.remove(&number);
        self.news.messages.extend(message.map(|(sent, message)| (sent, now, message)));
    }

    fn selected(&mut self, now: Time, rank: Rank, source: &Source) {
        let lane = &mut self.lanes[rank];
        lane.chosen = Some((Doing::of(activity_of(source)), now));
        lane.queue_left = lane.queue;
    }

    fn shot(&mut self, now: Time, rank: Rank, source: &Source, shot: &Shot, _: Rgb) {
        self.now = self.now.max(now);
        let lane = &mut self.lanes[rank];
        // Kernels that take no time leave no span.
        let instant = Span { activity: activity_of(source), from: now, to: now };
        lane.spans.push(lane.shooting.take().unwrap_or(instant));
        lane.chosen = None;
        let beam = Beam::of(source, shot);
        let power = beam.power.to_array().map(f64::to_bits);
        let fresh = self.known_sources.len() as u64;
        let emitter = *self.known_sources.entry((beam.source, power)).or_insert(fresh);
        if emitter == fresh {
            self.news.sources.push((beam.source, beam.power));
        }
        let fresh = self.known_shots.len() as u64;
        let number = *self.known_shots.entry(beam.key).or_insert(fresh);
        if number == fresh {
            self.news.beams.push(beam);
        }
        let (queue, memory) = (lane.queue_left, lane.memory);
        self.news.shots.push(ShotNews { rank, number, source: emitter, queue, memory });
        if self.audience.is_due() {
            self.tell();
        }
    }

    fn queue(&mut self, _: Time, rank: Rank, length: usize) {
        self.lanes[rank].queue = length as u64;
    }

    fn memory(&mut self, _: Time, rank: Rank, bytes: u64) {
        self.lanes[rank].memory = bytes;
    }
}

fn activity_of(source: &Source) -> Activity {
    if source.is_local() { Activity::LocalShot } else { Activity::ReceivedShot }
}
