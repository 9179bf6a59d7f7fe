//! Tickets: which process waits for what, and how the wait ended.

use std::cell::RefCell;
use std::fmt;
use std::rc::Rc;

use crate::time::Time;

/// Identity of a process within its simulation, in order of creation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct ProcessId(pub(crate) usize);

/// Identity of one wait for events and signals. The waiting future retires its ticket when it is done
/// or dropped; events and signals that still hold the ticket then have no effect.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Ticket {
    slot: u32,
    /// Unique: distinguishes a wait from later ones in the same slot.
    issue: u64,
}

/// How a wait ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// The signal was notified.
    Notified,
    /// The time was reached.
    TimeCame,
}

/// What a wait is for.
#[derive(Clone)]
pub(crate) enum Reason {
    Signal(Rc<Waiters>),
    Time(Time),
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Reason::Signal(waiters) => f.write_str(&waiters.name),
            Reason::Time(time) => time.fmt(f),
        }
    }
}

/// The waits for one signal.
pub(crate) struct Waiters {
    /// The signal's name.
    pub(crate) name: String,
    /// In order of arrival.
    pub(crate) tickets: RefCell<Vec<Ticket>>,
}

/// The wait of a ticket.
struct Slot {
    issue: u64,
    process: ProcessId,
    outcome: Option<Outcome>,
    /// None once the ticket is retired.
    on: Option<Reason>,
}

/// All tickets, in slots that are reused: a wait allocates no memory of its own.
#[derive(Default)]
pub(crate) struct Tickets {
    slots: Vec<Slot>,
    free: Vec<u32>,
    issued: u64,
}

impl Tickets {
    /// A ticket for a new wait.
    #[inline]
    pub(crate) fn issue(&mut self, process: ProcessId, on: Reason) -> Ticket {
        self.issued += 1;
        let slot = Slot { issue: self.issued, process, outcome: None, on: Some(on) };
        let number = self.free.pop().unwrap_or(self.slots.len() as u32);
        match self.slots.get_mut(number as usize) {
            Some(free) => *free = slot,
            None => self.slots.push(slot),
        }
        Ticket { slot: number, issue: self.issued }
    }

    /// The wait has ended or was dropped.
    #[inline]
    pub(crate) fn retire(&mut self, ticket: Ticket) {
        if self.is_held(ticket) {
            self.slots[ticket.slot as usize].on = None;
            self.free.push(ticket.slot);
        }
    }

    /// Decides how a wait ends, unless that is already decided. Returns whether it was still open.
    pub(crate) fn end(&mut self, ticket: Ticket, outcome: Outcome) -> bool {
        let open = self.is_open(ticket);
        if open {
            self.slots[ticket.slot as usize].outcome = Some(outcome);
        }
        open
    }

    /// Whether the wait goes on and its end is not decided.
    pub(crate) fn is_open(&self, ticket: Ticket) -> bool {
        self.is_held(ticket) && self.slots[ticket.slot as usize].outcome.is_none()
    }

    /// Whether the waiting future still exists.
    pub(crate) fn is_held(&self, ticket: Ticket) -> bool {
        let slot = &self.slots[ticket.slot as usize];
        slot.issue == ticket.issue && slot.on.is_some()
    }

    /// The process that waits, or waited, with the latest ticket of this slot.
    pub(crate) fn process(&self, ticket: Ticket) -> ProcessId {
        self.slots[ticket.slot as usize].process
    }

    /// How the wait of a ticket that is held ended, if it did.
    pub(crate) fn outcome(&self, ticket: Ticket) -> Option<Outcome> {
        self.slots[ticket.slot as usize].outcome
    }

    /// What a process waits for: usually one thing, several if it awaits several futures.
    pub(crate) fn reasons(&self, process: ProcessId) -> impl Iterator<Item = &Reason> {
        let mut open: Vec<&Slot> =
            self.slots.iter().filter(|s| s.process == process && s.outcome.is_none()).collect();
        open.sort_unstable_by_key(|slot| slot.issue);
        open.into_iter().filter_map(|slot| slot.on.as_ref())
    }
}
