//! A recording of a run in memory: everything but the light itself.

use desim::{Duration, Time};
use multicomputer::{Rank, Stall};
use radiosity::{Rgb, Shot};

use super::energy::EnergyLedger;
use super::observer::{Activity, Observer, SentMessage, blocked};
use crate::problem::{Problem, Source};
use crate::wire::MessageKind;

/// What happened in a run.
#[derive(Clone, Debug, Default)]
pub struct Recording {
    /// What each node did, by rank; the service node's rank is the last.
    pub nodes: Vec<NodeRecord>,
    /// The messages in the order in which they were sent.
    pub messages: Vec<MessageRecord>,
    /// Where the energy was, from each change on.
    pub energy: Vec<EnergyAt>,
    ledger: EnergyLedger,
}

/// What a node did.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NodeRecord {
    /// Activities with their ends: each begins where the one before it ends, the first at zero.
    activities: Vec<(Activity, Time)>,
    /// Its shots, in the order of the spans in which they were made.
    pub shots: Vec<ShotRecord>,
    /// The number of sources in its queue, from each change on.
    pub queue: Vec<(Time, u32)>,
}

/// An activity of a node, from a time to a time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    /// The activity.
    pub activity: Activity,
    /// Its start.
    pub from: Time,
    /// Its end.
    pub to: Time,
}

/// A shot that was made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ShotRecord {
    /// When it ended.
    pub at: Time,
    /// The environment in which the source was shot.
    pub environment: u32,
    /// The environment of the emitter.
    pub source_environment: u32,
    /// The emitter in that environment.
    pub patch: u32,
}

/// A message that was sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MessageRecord {
    /// Its kind.
    pub kind: MessageKind,
    /// The rank that sent it.
    pub from: u32,
    /// The receiver's rank.
    pub to: u32,
    /// Its length.
    pub bytes: u32,
    /// Whether a coprocessor sent it; else a span of its sender's begins when it is sent, if that
    /// takes time.
    pub handed_over: bool,
    /// When it went onto the network.
    pub sent: Time,
    /// When it reached its receiver's node, if it did.
    pub arrived: Option<Time>,
    /// When the receiver began to read it, if it did.
    pub read: Option<Time>,
    /// How long other messages blocked it.
    pub blocked: Duration,
}

/// Where the energy is from a moment on, W, colours summed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyAt {
    /// The moment.
    pub at: Time,
    /// On patches, not shot.
    pub unshot: f64,
    /// In sources selected or handed on, and not shot yet, and gathered by virtual walls.
    pub in_transit: f64,
    /// Absorbed by patches, by backs of polygons and by participating media.
    pub absorbed: f64,
    /// Gone out of the scene.
    pub escaped: f64,
}

impl EnergyAt {
    fn of(at: Time, ledger: &EnergyLedger) -> EnergyAt {
        EnergyAt {
            at,
            unshot: ledger.unshot.element_sum(),
            in_transit: ledger.in_transit.element_sum(),
            absorbed: (ledger.absorbed + ledger.medium).element_sum(),
            escaped: ledger.escaped.element_sum(),
        }
    }
}

impl NodeRecord {
    /// The node's activities, one after the other, from the start until it knew of the end.
    pub fn spans(&self) -> impl Iterator<Item = Span> {
        let starts = [Time::ZERO].into_iter().chain(self.activities.iter().map(|&(_, to)| to));
        let spans = self.activities.iter().zip(starts);
        spans.map(|(&(activity, to), from)| Span { activity, from, to })
    }

    /// When the node knew of the end.
    pub fn end(&self) -> Time {
        self.activities.last().map_or(Time::ZERO, |&(_, to)| to)
    }

    /// The total time of the activities asked for.
    pub fn time(&self, of: impl Fn(Activity) -> bool) -> Duration {
        self.spans().filter(|span| of(span.activity)).map(|span| span.to - span.from).sum()
    }
}

impl Recording {
    /// An empty recording of a run on `processors`, to be given to [`crate::simulate_observed`].
    pub fn new(problem: &Problem, processors: usize) -> Recording {
        let ledger = EnergyLedger::at_first(problem.emitted_power());
        Recording {
            nodes: vec![NodeRecord::default(); processors + 1],
            messages: Vec::new(),
            energy: vec![EnergyAt::of(Time::ZERO, &ledger)],
            ledger,
        }
    }

    fn message(&mut self, number: u64) -> Option<&mut MessageRecord> {
        self.messages.get_mut(number as usize)
    }

    /// Several changes of one moment are one.
    fn energy_changed(&mut self, now: Time) {
        if self.energy.last().is_some_and(|last| last.at == now) {
            self.energy.pop();
        }
        self.energy.push(EnergyAt::of(now, &self.ledger));
    }
}

impl Observer for Recording {
    fn activity(&mut self, rank: Rank, activity: Activity, _: Time, to: Time) {
        self.nodes[rank].activities.push((activity, to));
    }

    fn sent(&mut self, now: Time, message: &SentMessage) {
        self.messages.push(MessageRecord {
            kind: message.kind,
            from: message.from as u32,
            to: message.to as u32,
            bytes: message.bytes as u32,
            handed_over: message.handed_over,
            sent: now,
            arrived: None,
            read: None,
            blocked: Duration::ZERO,
        });
    }

    fn arrived(&mut self, now: Time, number: u64, stalls: &[Stall]) {
        if let Some(message) = self.message(number) {
            message.arrived = Some(now);
            message.blocked = blocked(stalls);
        }
    }

    fn read(&mut self, now: Time, _: Rank, number: u64) {
        self.message(number).into_iter().for_each(|message| message.read = Some(now));
    }

    fn selected(&mut self, now: Time, _: Rank, source: &Source) {
        self.ledger.selected(source);
        self.energy_changed(now);
    }

    fn shot(&mut self, now: Time, rank: Rank, source: &Source, shot: &Shot, reflected: Rgb) {
        self.nodes[rank].shots.push(ShotRecord {
            at: now,
            environment: source.environment,
            source_environment: source.emitter.environment,
            patch: source.emitter.patch,
        });
        self.ledger.shot(source, shot, reflected);
        self.energy_changed(now);
    }

    fn queue(&mut self, now: Time, rank: Rank, length: usize) {
        self.nodes[rank].queue.push((now, length as u32));
    }
}
