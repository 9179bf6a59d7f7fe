//! What a network will do, in the order of time.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use desim::Time;

/// Things to do, by (time, number): of two at one time the one entered first comes first.
pub(crate) struct Agenda<T> {
    entries: BinaryHeap<Entry<T>>,
    entered: u64,
}

struct Entry<T> {
    time: Time,
    number: u64,
    what: T,
}

impl<T> Agenda<T> {
    pub(crate) fn enter(&mut self, time: Time, what: T) {
        self.entries.push(Entry { time, number: self.entered, what });
        self.entered += 1;
    }

    /// The time of the first entry.
    pub(crate) fn next_time(&self) -> Option<Time> {
        self.entries.peek().map(|entry| entry.time)
    }

    /// Removes the first entry, if it is not after `now`.
    pub(crate) fn take_due(&mut self, now: Time) -> Option<(Time, T)> {
        if self.next_time()? > now {
            return None;
        }
        self.entries.pop().map(|entry| (entry.time, entry.what))
    }
}

impl<T> Default for Agenda<T> {
    fn default() -> Agenda<T> {
        Agenda { entries: BinaryHeap::new(), entered: 0 }
    }
}

/// The earliest is the greatest, since a [`BinaryHeap`] gives the greatest first.
impl<T> Ord for Entry<T> {
    fn cmp(&self, other: &Entry<T>) -> Ordering {
        (other.time, other.number).cmp(&(self.time, self.number))
    }
}

impl<T> PartialOrd for Entry<T> {
    fn partial_cmp(&self, other: &Entry<T>) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<T> PartialEq for Entry<T> {
    fn eq(&self, other: &Entry<T>) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl<T> Eq for Entry<T> {}
