//! Events to come, ordered by (time, sequence number).

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::time::Time;

/// Events to come. The sequence number is given when an event is scheduled: of two events at one time
/// the one scheduled first happens first.
pub struct EventQueue<T> {
    /// Time, number, and the slot of the event itself: a heap moves small entries faster.
    order: BinaryHeap<Reverse<(Time, u64, u32)>>,
    events: Vec<Option<T>>,
    free: Vec<u32>,
    scheduled: u64,
}

impl<T> EventQueue<T> {
    /// Adds an event.
    #[inline]
    pub fn schedule(&mut self, time: Time, event: T) {
        let slot = self.free.pop().unwrap_or(self.events.len() as u32);
        match self.events.get_mut(slot as usize) {
            Some(free) => *free = Some(event),
            None => self.events.push(Some(event)),
        }
        self.order.push(Reverse((time, self.scheduled, slot)));
        self.scheduled += 1;
    }

    /// The time of the next event.
    #[inline]
    pub fn next_time(&self) -> Option<Time> {
        self.order.peek().map(|Reverse((time, ..))| *time)
    }

    /// Removes the next event.
    #[inline]
    pub fn take(&mut self) -> Option<(Time, T)> {
        let Reverse((time, _, slot)) = self.order.pop()?;
        self.free.push(slot);
        Some((time, self.events[slot as usize].take()?))
    }

    /// Removes the next event if it is not after `now`.
    #[inline]
    pub fn take_due(&mut self, now: Time) -> Option<(Time, T)> {
        self.next_time().filter(|&time| time <= now)?;
        self.take()
    }
}

impl<T> Default for EventQueue<T> {
    fn default() -> EventQueue<T> {
        let (order, events) = (BinaryHeap::new(), Vec::new());
        EventQueue { order, events, free: Vec::new(), scheduled: 0 }
    }
}
