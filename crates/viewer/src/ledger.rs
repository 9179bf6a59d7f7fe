//! Where all nodes' time went, and what bounds a run from below.

use desim::{Duration, Time};
use virtwall::{Activity, NodeRecord, Recording};

use crate::critical::Link;
use crate::film::Doing;

/// Where the time of one compute node, or of all, went, seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Ledger {
    /// By [`Doing`]; waiting is below.
    pub doing: [f64; Doing::COUNT],
    /// Waiting before the first shot.
    pub before: f64,
    /// Waiting between shots.
    pub between: f64,
    /// Waiting after the last shot.
    pub after: f64,
}

fn is_shot(activity: Activity) -> bool {
    matches!(activity, Activity::LocalShot | Activity::ReceivedShot)
}

impl Ledger {
    /// Of one node, until `end`, when the last node knew that the run was over.
    pub fn of(node: &NodeRecord, end: Time) -> Ledger {
        let shots = || node.spans().filter(|span| is_shot(span.activity));
        let first = shots().map(|span| span.from).next().unwrap_or(Time::MAX);
        let last = shots().map(|span| span.to).last().unwrap_or(Time::ZERO);
        let mut ledger = Ledger::default();
        for span in node.spans() {
            let seconds = (span.to - span.from).as_seconds_f64();
            *match Doing::of(span.activity) {
                Doing::Waiting if span.to <= first => &mut ledger.before,
                Doing::Waiting if span.from >= last => &mut ledger.after,
                Doing::Waiting => &mut ledger.between,
                doing => &mut ledger.doing[doing as usize],
            } += seconds;
        }
        ledger.after += (end - node.end()).as_seconds_f64();
        ledger
    }

    /// Adds another node's.
    pub fn add(&mut self, other: &Ledger) {
        self.doing.iter_mut().zip(other.doing).for_each(|(sum, more)| *sum += more);
        self.before += other.before;
        self.between += other.between;
        self.after += other.after;
    }

    /// Time in kernels.
    pub fn computing(&self) -> f64 {
        [Doing::LocalShot, Doing::ReceivedShot, Doing::Selection]
            .iter()
            .map(|&d| self.of_doing(d))
            .sum()
    }

    /// Time given to messages.
    pub fn overhead(&self) -> f64 {
        [Doing::Sending, Doing::Receiving, Doing::Control, Doing::Held]
            .iter()
            .map(|&d| self.of_doing(d))
            .sum()
    }

    /// Time waiting for something to arrive.
    pub fn waiting(&self) -> f64 {
        self.before + self.between + self.after
    }

    /// Time in one thing.
    pub fn of_doing(&self, doing: Doing) -> f64 {
        self.doing[doing as usize]
    }
}

/// What decided how long a run took.
pub(crate) struct Account {
    /// By rank, of compute nodes.
    pub nodes: Vec<Ledger>,
    /// Of all compute nodes.
    pub all: Ledger,
    /// The compute node that computed longest.
    pub busiest: usize,
    /// The compute node that ended a shot last, and when.
    pub last_shot: Option<(usize, Time)>,
    /// The compute node that was the last to know of the end, and when.
    pub last: (usize, Time),
    /// Compute nodes that shot patches of their own.
    pub with_sources: usize,
    /// Seconds of shots in each environment.
    pub environments: Vec<f64>,
    /// Seconds of the critical path by [`Doing`].
    pub path: [f64; Doing::COUNT],
}

impl Account {
    /// Of a run and its critical path.
    pub fn of(recording: &Recording, path: &[Link]) -> Account {
        let compute = &recording.nodes[..recording.nodes.len() - 1];
        // Of equals the first.
        let latest = |times: &mut dyn Iterator<Item = (usize, Time)>| {
            times.fold(None, |best: Option<(usize, Time)>, (node, time)| match best {
                Some((_, other)) if time <= other => best,
                _ => Some((node, time)),
            })
        };
        let ends = &mut compute.iter().map(NodeRecord::end).enumerate();
        let last = latest(ends).unwrap_or_default();
        let shots = compute.iter().enumerate();
        let last_shot =
            latest(&mut shots.filter_map(|(node, record)| Some((node, record.shots.last()?.at))));
        let nodes: Vec<Ledger> = compute.iter().map(|node| Ledger::of(node, last.1)).collect();
        let mut all = Ledger::default();
        nodes.iter().for_each(|node| all.add(node));
        let busier = |best: usize, node: usize| {
            if nodes[node].computing() > nodes[best].computing() { node } else { best }
        };
        let busiest = (0..nodes.len()).fold(0, busier);
        let local = |node: &&NodeRecord| {
            node.shots.iter().any(|shot| shot.environment == shot.source_environment)
        };
        let with_sources = compute.iter().filter(local).count();
        let environments = environments(compute);
        let mut seconds = [Duration::ZERO; Doing::COUNT];
        path.iter().for_each(|link| seconds[link.doing as usize] += link.to - link.from);
        let path = seconds.map(Duration::as_seconds_f64);
        Account { nodes, all, busiest, last_shot, last, with_sources, environments, path }
    }
}

/// Seconds of shots in each environment, wherever it lies.
fn environments(nodes: &[NodeRecord]) -> Vec<f64> {
    let mut seconds = Vec::new();
    for node in nodes {
        let mut shots = node.shots.iter().peekable();
        for span in node.spans().filter(|span| is_shot(span.activity)) {
            // Kernels that take no time leave no span.
            while shots.next_if(|shot| shot.at < span.to).is_some() {}
            let Some(shot) = shots.next() else { break };
            let environment = shot.environment as usize;
            seconds.resize(seconds.len().max(environment + 1), 0.0);
            seconds[environment] += (span.to - span.from).as_seconds_f64();
        }
    }
    seconds
}
