//! What all back ends share: casting shots ahead, counting operations and messages, encoding messages.

use std::borrow::Cow;
use std::cell::Cell;
use std::sync::Arc;

use radiosity::Work;

use super::error::RunError;
use super::progress::Progress;
use crate::casting::LookAhead;
use crate::problem::{Rank, Source};
use crate::program::{Event, ProgramError};
use crate::run::{Counts, Outcome};
use crate::wire::{Message, MessageKind};

/// What the host does with the events of a run: it casts shots ahead and reports progress.
#[derive(Clone)]
pub(super) struct Host {
    pub look_ahead: Arc<LookAhead>,
    pub progress: Arc<Progress>,
    /// Called after every shot with its source.
    pub on_shot: Arc<dyn Fn(&Source) + Send + Sync>,
}

impl Host {
    /// Handles an event of a program.
    pub fn note(&self, event: &Event) {
        match event {
            Event::Brightest(emitter) => self.look_ahead.foresee_patch(emitter),
            Event::HandedOn(source) => self.look_ahead.foresee(Cow::Borrowed(source)),
            Event::Shot { source, .. } => {
                self.progress.shot(source);
                (self.on_shot)(source);
            }
            Event::Selected(_) | Event::Queued { .. } | Event::Taken { .. } => {}
        }
    }
}

/// Counts the operations of a process and the messages that it sends.
#[derive(Default)]
pub(super) struct Meter {
    work: Cell<Work>,
    counts: Cell<Counts>,
}

impl Meter {
    /// Adds the operations of a step.
    pub fn work(&self, work: Work) {
        self.work.set(self.work.get() + work);
    }

    /// Encodes a message that the process sends, and counts it.
    pub fn encode(&self, message: &Message) -> Vec<u8> {
        let bytes = message.encode();
        let (mut counts, length) = (self.counts.get(), bytes.len() as u64);
        match MessageKind::of(message) {
            MessageKind::Source | MessageKind::WallPatch => {
                counts.messages += 1;
                counts.message_bytes += length;
            }
            MessageKind::Update => {
                counts.update_messages += 1;
                counts.update_bytes += length;
            }
            _ => counts.control_messages += 1,
        }
        self.counts.set(counts);
        bytes
    }

    /// The counts so far.
    pub fn read(&self) -> (Counts, Work) {
        (self.counts.get(), self.work.get())
    }
}

/// The sum of the counts of all processes.
pub(super) fn total(meters: impl IntoIterator<Item = (Counts, Work)>) -> (Counts, Work) {
    meters.into_iter().fold((Counts::default(), Work::NONE), |mut all, (counts, work)| {
        all.0 += counts;
        all.1 += work;
        all
    })
}

/// Decodes a message. An error names its sender and receiver.
pub(super) fn decode(to: Rank, from: Rank, bytes: &[u8]) -> Result<(Rank, Message), ProgramError> {
    let unreadable = |error| ProgramError::Unreadable { from, to, error };
    Ok((from, Message::decode(bytes).map_err(unreadable)?))
}

/// Refuses an outcome whose energy does not balance.
pub(super) fn balanced(outcome: Outcome) -> Result<Outcome, RunError> {
    match outcome.energy.error() {
        error if error <= RunError::LARGEST_ENERGY_ERROR => Ok(outcome),
        error => Err(RunError::Unbalanced { error }),
    }
}
