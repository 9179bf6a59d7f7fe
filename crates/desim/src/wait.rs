//! The future on which all waits of this crate are built.

use std::future::Future;
use std::pin::Pin;
use std::rc::Rc;
use std::task::{Context, Poll};

use crate::event::Event;
use crate::state::State;
use crate::ticket::{Outcome, Reason, Ticket};
use crate::time::Time;

/// Waits for a signal, a time, or the first of both. Begins at the first poll.
pub(crate) struct Wait {
    state: Rc<State>,
    on: Reason,
    until: Option<Time>,
    ticket: Option<Ticket>,
}

impl Wait {
    /// A wait that has not begun and ends at `until` at the latest.
    pub(crate) fn new(state: &Rc<State>, on: Reason, until: Option<Time>) -> Wait {
        Wait { state: Rc::clone(state), on, until, ticket: None }
    }

    fn begin(&self) -> Ticket {
        let ticket = self.state.issue_ticket(self.on.clone());
        if let Reason::Signal(waiters) = &self.on {
            let tickets = self.state.tickets.borrow();
            let mut waiting = waiters.tickets.borrow_mut();
            // Removes ended waits: otherwise waits that time out would accumulate.
            waiting.retain(|&earlier| tickets.is_open(earlier));
            waiting.push(ticket);
        }
        if let Some(time) = self.until {
            self.state.schedule(time, Event::Timer(ticket));
        }
        ticket
    }
}

impl Future for Wait {
    type Output = Outcome;

    fn poll(mut self: Pin<&mut Self>, _: &mut Context<'_>) -> Poll<Outcome> {
        let Some(ticket) = self.ticket else {
            self.ticket = Some(self.begin());
            return Poll::Pending;
        };
        self.state.tickets.borrow().outcome(ticket).map_or(Poll::Pending, Poll::Ready)
    }
}

impl Drop for Wait {
    fn drop(&mut self) {
        if let Some(ticket) = self.ticket {
            self.state.tickets.borrow_mut().retire(ticket);
        }
    }
}
