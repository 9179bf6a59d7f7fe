//! The event queue: ordered by (time, sequence number).

use std::collections::BTreeMap;
use std::rc::Weak;

use crate::ticket::{ProcessId, Ticket};
use crate::time::Time;

/// What happens at a moment of virtual time.
pub(crate) enum Event {
    /// A process runs for the first time.
    Start(ProcessId),
    /// The time that a wait lasts at most has come.
    Timer(Weak<Ticket>),
    /// A process whose wait a signal has ended goes on.
    Wake(Weak<Ticket>),
    /// A callback runs.
    Call(Box<dyn FnOnce()>),
}

impl Event {
    /// Whether nothing is left to do: the wait was given up, or a signal ended it before its time.
    /// Such an event must not even move the clock.
    fn is_stale(&self) -> bool {
        match self {
            Event::Start(_) | Event::Call(_) => false,
            Event::Timer(ticket) => ticket.upgrade().is_none_or(|t| t.outcome.get().is_some()),
            Event::Wake(ticket) => ticket.strong_count() == 0,
        }
    }
}

/// Events to come. The sequence number is given when an event is scheduled, so that of two events
/// at one time the one scheduled first happens first.
#[derive(Default)]
pub(crate) struct EventQueue {
    events: BTreeMap<(Time, u64), Event>,
    scheduled: u64,
}

impl EventQueue {
    /// Adds an event.
    pub(crate) fn schedule(&mut self, time: Time, event: Event) {
        self.events.insert((time, self.scheduled), event);
        self.scheduled += 1;
    }

    /// Removes the next event that still matters.
    pub(crate) fn next(&mut self) -> Option<(Time, Event)> {
        while let Some(((time, _), event)) = self.events.pop_first() {
            if !event.is_stale() {
                return Some((time, event));
            }
        }
        None
    }
}
