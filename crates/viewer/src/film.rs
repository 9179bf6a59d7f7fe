//! A run as its viewer needs it: all that happened, and what every shot brought to which patch.

use desim::Time;
use multicomputer::{Rank, Stall};
use radiosity::{Rgb, Shot};
use virtwall::{Activity, MessageKind, Observer, Problem, Recording, SentMessage, ShotKey, Source};

/// An observer that remembers a run.
pub struct Film {
    pub(crate) recording: Recording,
    /// By rank, in step with the recording's shots.
    pub(crate) beams: Vec<Vec<Beam>>,
    /// By rank, how many bytes its program keeps, from each change on; nothing where that is not
    /// modelled.
    pub(crate) memory: Vec<Vec<(Time, u64)>>,
}

/// What a shot was, and what it hit.
pub(crate) struct Beam {
    pub key: ShotKey,
    pub environment: u32,
    /// Environment and patch of the emitter.
    pub source: (u32, u32),
    /// W.
    pub power: Rgb,
    /// Patches and form factors.
    pub hits: Vec<(u32, f32)>,
    pub backs: f64,
    pub escaped: f64,
    /// Form factor of what participating media absorbed.
    pub medium: f64,
    /// Form factor of what went on to neighbours.
    pub outgoing: f64,
}

impl Beam {
    pub fn of(source: &Source, shot: &Shot) -> Beam {
        let hits = shot.hits.iter();
        Beam {
            key: ShotKey::of(source),
            environment: source.environment,
            source: (source.emitter.environment, source.emitter.patch),
            power: source.emitter.power,
            hits: hits.map(|&(patch, form_factor)| (patch, form_factor as f32)).collect(),
            backs: shot.backs,
            escaped: shot.escaped,
            medium: shot.medium,
            outgoing: shot.outgoing.iter().flatten().map(|out| out.form_factor).sum(),
        }
    }
}

impl Film {
    /// For a run of a problem on so many processors.
    pub fn new(problem: &Problem, processors: usize) -> Film {
        let beams = std::iter::repeat_with(Vec::new).take(processors + 1).collect();
        let recording = Recording::new(problem, processors);
        Film { recording, beams, memory: vec![Vec::new(); processors + 1] }
    }

    /// All but the light.
    pub fn recording(&self) -> &Recording {
        &self.recording
    }

    /// Compute nodes.
    pub fn processors(&self) -> usize {
        self.beams.len() - 1
    }
}

impl Observer for Film {
    fn activity(&mut self, rank: Rank, activity: Activity, from: Time, to: Time) {
        self.recording.activity(rank, activity, from, to);
    }

    fn sent(&mut self, now: Time, message: &SentMessage) {
        self.recording.sent(now, message);
    }

    fn arrived(&mut self, now: Time, number: u64, stalls: &[Stall]) {
        self.recording.arrived(now, number, stalls);
    }

    fn read(&mut self, now: Time, rank: Rank, number: u64) {
        self.recording.read(now, rank, number);
    }

    fn selected(&mut self, now: Time, rank: Rank, source: &Source) {
        self.recording.selected(now, rank, source);
    }

    fn shot(&mut self, now: Time, rank: Rank, source: &Source, shot: &Shot, reflected: Rgb) {
        self.recording.shot(now, rank, source, shot, reflected);
        self.beams[rank].push(Beam::of(source, shot));
    }

    fn queue(&mut self, now: Time, rank: Rank, length: usize) {
        self.recording.queue(now, rank, length);
    }

    fn memory(&mut self, now: Time, rank: Rank, bytes: u64) {
        self.memory[rank].push((now, bytes));
    }
}

/// What a node does, as the page tells it; waiting is what lies between. `assets/run.js` has the same
/// list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Doing {
    LocalShot,
    ReceivedShot,
    Selection,
    Sending,
    Receiving,
    Control,
    Paging,
    Held,
    /// Only on a critical path: a message is under way.
    Travelling,
    /// The same: nothing that was recorded explains the wait.
    Waiting,
}

impl Doing {
    /// How many there are.
    pub const COUNT: usize = Doing::Waiting as usize + 1;

    /// Of an activity.
    pub fn of(activity: Activity) -> Doing {
        match activity {
            Activity::Selection => Doing::Selection,
            Activity::LocalShot => Doing::LocalShot,
            Activity::ReceivedShot => Doing::ReceivedShot,
            Activity::Send(MessageKind::Token | MessageKind::Done) => Doing::Control,
            Activity::Send(MessageKind::Collect | MessageKind::Sums) => Doing::Control,
            Activity::Send(MessageKind::StopSelecting) => Doing::Control,
            Activity::Send(_) | Activity::Pack | Activity::Forward => Doing::Sending,
            Activity::Receive | Activity::Copy => Doing::Receiving,
            Activity::WaitForRoom | Activity::WaitForDisplay => Doing::Held,
            Activity::Paging => Doing::Paging,
            Activity::Wait => Doing::Waiting,
        }
    }
}
