//! Tickets: who waits for what, and how the wait ended.

use std::cell::{Cell, RefCell};
use std::fmt;
use std::rc::{Rc, Weak};

use crate::time::Time;

/// Identity of a process within its simulation, in order of creation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ProcessId(pub(crate) usize);

/// One wait under way. The waiting future owns it; events and signals hold it weakly, so that
/// whatever they still have in hand when the future is done or dropped does no harm.
pub(crate) struct Ticket {
    pub(crate) process: ProcessId,
    pub(crate) on: Reason,
    pub(crate) outcome: Cell<Option<Outcome>>,
}

/// How a wait ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// The signal came.
    Notified,
    /// The time came.
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

/// Those who wait for one signal.
pub(crate) struct Waiters {
    /// The signal's name.
    pub(crate) name: String,
    /// In order of arrival.
    pub(crate) tickets: RefCell<Vec<Weak<Ticket>>>,
}

impl Waiters {
    /// Adds a waiter, and forgets those that gave up: else waits that time out would pile up.
    pub(crate) fn enlist(&self, ticket: &Rc<Ticket>) {
        let mut tickets = self.tickets.borrow_mut();
        tickets.retain(|ticket| ticket.strong_count() > 0);
        tickets.push(Rc::downgrade(ticket));
    }
}
