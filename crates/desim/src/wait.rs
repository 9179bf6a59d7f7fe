//! Waiting: the one future on which all others of this crate are built.

use std::cell::Cell;
use std::fmt;
use std::future::Future;
use std::pin::Pin;
use std::rc::Rc;
use std::task::{Context, Poll};

use crate::event::Event;
use crate::handle::Handle;
use crate::process::ProcessId;
use crate::signal::Signal;
use crate::time::Time;

/// How a wait ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// The signal came.
    Notified,
    /// The time came.
    TimeCame,
}

/// One wait under way. The waiting future owns it; events and signals hold it weakly, so that
/// whatever they still have in hand when the future is done or dropped does no harm.
pub(crate) struct Ticket {
    pub(crate) process: ProcessId,
    pub(crate) on: Reason,
    pub(crate) outcome: Cell<Option<Outcome>>,
}

/// What a wait is for.
pub(crate) enum Reason {
    Signal(Rc<str>),
    Time(Time),
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Reason::Signal(name) => f.write_str(name),
            Reason::Time(time) => time.fmt(f),
        }
    }
}

/// Waits for a signal, a time, or whichever comes first. Begins when first polled.
pub(crate) struct Wait {
    pub(crate) handle: Handle,
    pub(crate) signal: Option<Signal>,
    pub(crate) until: Option<Time>,
    pub(crate) ticket: Option<Rc<Ticket>>,
}

impl Wait {
    fn begin(&self) -> Rc<Ticket> {
        let on = match (&self.signal, self.until) {
            (Some(signal), _) => Reason::Signal(signal.name()),
            (None, until) => Reason::Time(until.unwrap_or(Time::MAX)),
        };
        let ticket = self.handle.issue_ticket(on);
        if let Some(signal) = &self.signal {
            signal.enlist(&ticket);
        }
        if let Some(time) = self.until {
            self.handle.schedule(time, Event::Timer(Rc::downgrade(&ticket)));
        }
        ticket
    }
}

impl Future for Wait {
    type Output = Outcome;

    fn poll(mut self: Pin<&mut Self>, _: &mut Context<'_>) -> Poll<Outcome> {
        let Some(ticket) = &self.ticket else {
            self.ticket = Some(self.begin());
            return Poll::Pending;
        };
        match ticket.outcome.get() {
            Some(outcome) => Poll::Ready(outcome),
            None => Poll::Pending,
        }
    }
}
