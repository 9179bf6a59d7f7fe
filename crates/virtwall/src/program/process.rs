//! The interface between the programs and a back end: what a program may do on its node.

use std::collections::BTreeSet;

use desim::Time;
use radiosity::{Emitter, Rgb, Shot, Work};
use thiserror::Error;

use super::queue::{Queue, Turn};
use crate::problem::{Rank, Source};
use crate::wire::{DecodeError, Message};

/// A process on a node: simulated, a thread, or one of a real machine. The program says what it does; the
/// back end knows what that costs.
#[expect(async_fn_in_trait, reason = "a process stays on its own thread")]
pub trait Process {
    /// Its rank.
    fn rank(&self) -> Rank;

    /// The time since the program began.
    fn now(&self) -> Time;

    /// Carry out a step of the program; `job` returns the operations that it counted.
    async fn compute<T>(&self, step: Step<'_>, job: impl FnOnce() -> (T, Work)) -> T;

    /// Send a message.
    async fn send(&self, to: Rank, message: Message);

    /// The messages that have arrived since the last call, with their senders, in order of arrival.
    ///
    /// # Errors
    /// If one of them cannot be read, or the run makes no progress.
    async fn receive(&self) -> Result<Vec<(Rank, Message)>, ProgramError>;

    /// Idle until a message has arrived that was not received, or until a time. Returns whether a message has
    /// arrived.
    async fn wait(&self, until: Option<Time>) -> bool;

    /// Report an event of the program. It has no answer, so the program cannot depend on it.
    fn note(&self, _event: Event<'_>) {}
}

/// What a program computes.
pub enum Step<'a> {
    /// Search for the best source (§4.2.2).
    Select {
        /// The local environments whose patches are searched.
        searched: &'a BTreeSet<u32>,
        /// The queue, which is searched whole.
        queued: &'a Queue,
    },
    /// Cast the rays of a source and update radiosities (§4.2.3).
    Shoot(&'a Source),
    /// Gather on virtual walls what leaves an environment.
    Gather,
}

/// What has happened in a program.
pub enum Event<'a> {
    /// Another patch has become the brightest of its environment. It will be shot sooner or later: its
    /// unshot power only grows.
    Brightest(&'a Emitter),
    /// A source was selected.
    Selected(&'a Source),
    /// A source was shot, and the patches reflect this power of it, W.
    Shot {
        /// The source.
        source: &'a Source,
        /// Where its rays ended.
        shot: &'a Shot,
        /// Reflected power, W.
        reflected: Rgb,
    },
    /// A source is handed on to its environment, on this node or another.
    HandedOn(&'a Source),
    /// A source was put into the queue, which now holds `waiting`.
    Queued {
        /// The source.
        source: &'a Source,
        /// Its number in the queue.
        turn: Turn,
        /// Sources in the queue.
        waiting: usize,
    },
    /// A source was taken from the queue, which now holds `waiting`.
    Taken {
        /// Its number in the queue.
        turn: Turn,
        /// Sources in the queue.
        waiting: usize,
    },
}

/// Why a program cannot go on. It ends the run.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ProgramError {
    /// A message that cannot be read.
    #[error("process {to} received a message from process {from} that cannot be read: {error}")]
    Unreadable {
        /// The sender.
        from: Rank,
        /// The receiver.
        to: Rank,
        /// What is wrong with it.
        error: DecodeError,
    },
    /// Shots go on, but light does not fall.
    #[error(transparent)]
    NoProgress(#[from] NoProgress),
}

/// Shots of patches that carried too much of what as many shots before them carried.
#[derive(Clone, Debug, Error, PartialEq)]
#[error(
    "no progress after {shots} shots of patches: the last {window} of them carried {:.1e} % of the emitted power, \
     and the {window} before these {:.1e} %; expected {most:.2} times that at most \
     (\"stop.shots_without_progress\"). Processors with little to do shoot the least light that arrives while \
     others fall behind, or over-shooting diverges: try a higher \"stop.patch_threshold\", another \
     \"mapping\", fewer processors, a smaller \"overshoot\"",
    100.0 * now,
    100.0 * before
)]
pub struct NoProgress {
    /// All shots of patches.
    pub shots: u64,
    /// Those that are compared with as many before them.
    pub window: u64,
    /// The power that these before carried, as a share of the emitted power.
    pub before: f64,
    /// The power that the last ones carried, in the same way.
    pub now: f64,
    /// What it may be, as a part of `before`.
    pub most: f64,
}
