//! Records a run with what every shot brought to which patch, so that the light of any instant can be
//! shown.

use desim::Time;
use multicomputer::{Rank, Stall};
use radiosity::{Rgb, Shot};
use virtwall::{Activity, Observer, Problem, Recording, SentMessage, ShotKey, Source};

/// An observer that records a run.
pub struct LightRecording {
    /// All but the light.
    pub recording: Recording,
    /// The shots of each rank, in the order of the recording's shots.
    pub(crate) shots: Vec<Vec<RecordedShot>>,
    /// By rank, the bytes of memory in use from each change on; empty where memory is not modelled.
    pub(crate) memory: Vec<Vec<(Time, u64)>>,
}

/// A shot and what it hit.
pub(crate) struct RecordedShot {
    pub key: ShotKey,
    /// The environment in which the source was shot.
    pub environment: u32,
    /// Environment and patch of the emitter.
    pub emitter: (u32, u32),
    /// W.
    pub power: Rgb,
    /// Patches and form factors.
    pub hits: Vec<(u32, f32)>,
    /// Form factor of rays that hit backs of polygons.
    pub backs: f64,
    /// Form factor of rays that left the scene.
    pub escaped: f64,
    /// Form factor of what participating media absorbed.
    pub medium: f64,
    /// Form factor of what went on to neighbours.
    pub outgoing: f64,
}

impl RecordedShot {
    pub fn of(source: &Source, shot: &Shot) -> RecordedShot {
        RecordedShot {
            key: ShotKey::of(source),
            environment: source.environment,
            emitter: (source.emitter.environment, source.emitter.patch),
            power: source.emitter.power,
            hits: shot.hits.iter().map(|&(patch, factor)| (patch, factor as f32)).collect(),
            backs: shot.backs,
            escaped: shot.escaped,
            medium: shot.medium,
            outgoing: shot.outgoing.iter().flatten().map(|out| out.form_factor).sum(),
        }
    }
}

impl LightRecording {
    /// An empty recording of a run on `processors` compute nodes.
    pub fn new(problem: &Problem, processors: usize) -> LightRecording {
        let shots = std::iter::repeat_with(Vec::new).take(processors + 1).collect();
        let recording = Recording::new(problem, processors);
        LightRecording { recording, shots, memory: vec![Vec::new(); processors + 1] }
    }

    /// The number of compute nodes.
    pub fn processors(&self) -> usize {
        self.shots.len() - 1
    }
}

impl Observer for LightRecording {
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
        self.shots[rank].push(RecordedShot::of(source, shot));
    }

    fn queue(&mut self, now: Time, rank: Rank, length: usize) {
        self.recording.queue(now, rank, length);
    }

    fn memory(&mut self, now: Time, rank: Rank, bytes: u64) {
        self.memory[rank].push((now, bytes));
    }
}
