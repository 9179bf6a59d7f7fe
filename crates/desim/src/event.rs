//! The event queue: ordered by (time, sequence number).

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::rc::Rc;

use crate::repeated::Repeated;
use crate::ticket::{ProcessId, Ticket};
use crate::time::Time;

/// What happens at a moment of virtual time.
pub(crate) enum Event {
    /// A process runs for the first time.
    Start(ProcessId),
    /// The time that a wait lasts at most has come.
    Timer(Ticket),
    /// A process whose wait a signal has ended goes on.
    Wake(Ticket),
    /// A callback runs.
    Call(Box<dyn FnOnce()>),
    /// An alarm goes off, if it is still set for this time.
    Alarm(Rc<Repeated>),
}

/// Events to come. The sequence number is given when an event is scheduled, so that of two events
/// at one time the one scheduled first happens first.
#[derive(Default)]
pub(crate) struct EventQueue {
    /// Time, number, and the slot of the event itself: what a heap moves about should be small.
    order: BinaryHeap<Reverse<(Time, u64, u32)>>,
    events: Vec<Option<Event>>,
    free: Vec<u32>,
    scheduled: u64,
}

impl EventQueue {
    /// Adds an event.
    #[inline]
    pub(crate) fn schedule(&mut self, time: Time, event: Event) {
        let slot = self.free.pop().unwrap_or(self.events.len() as u32);
        match self.events.get_mut(slot as usize) {
            Some(free) => *free = Some(event),
            None => self.events.push(Some(event)),
        }
        self.order.push(Reverse((time, self.scheduled, slot)));
        self.scheduled += 1;
    }

    /// Removes the next event.
    #[inline]
    pub(crate) fn next(&mut self) -> Option<(Time, Event)> {
        let Reverse((time, _, slot)) = self.order.pop()?;
        self.free.push(slot);
        Some((time, self.events[slot as usize].take()?))
    }
}
