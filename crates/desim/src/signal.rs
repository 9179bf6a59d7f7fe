//! Signals: how one process wakes others.

use std::cell::RefCell;
use std::future::Future;
use std::rc::{Rc, Weak};

use crate::event::Event;
use crate::handle::Handle;
use crate::time::Time;
use crate::wait::{Outcome, Ticket, Wait};

/// A thing to wait for, without memory: a notification reaches those who wait at that moment, and
/// nobody else. Clones are the same signal.
#[derive(Clone)]
pub struct Signal(Rc<State>);

struct State {
    handle: Handle,
    name: Rc<str>,
    /// In order of arrival.
    waiters: RefCell<Vec<Weak<Ticket>>>,
}

impl Signal {
    /// A new signal; `name` is what a [`crate::Stalled`] report calls it.
    pub fn new(handle: &Handle, name: impl Into<String>) -> Signal {
        Signal(Rc::new(State {
            handle: handle.clone(),
            name: name.into().into(),
            waiters: RefCell::default(),
        }))
    }

    /// Wakes every waiting process by an event at the present time, first come, first served.
    pub fn notify(&self) {
        let now = self.0.handle.now();
        for waiter in self.0.waiters.take() {
            let Some(ticket) = waiter.upgrade() else { continue };
            // Decided here and not when the event comes: a timer of this very moment that is still
            // in the queue came second.
            if ticket.outcome.get().is_none() {
                ticket.outcome.set(Some(Outcome::Notified));
                self.0.handle.schedule(now, Event::Wake(waiter));
            }
        }
    }

    /// Waits, from when it is first polled, for the next notification.
    pub fn wait(&self) -> impl Future<Output = ()> + use<> {
        let wait = self.begin_wait(None);
        async move {
            wait.await;
        }
    }

    /// Waits for the next notification, at most until `time`: true if notified, false when the time
    /// came first. A time that is past counts as the present.
    pub fn wait_until(&self, time: Time) -> impl Future<Output = bool> + use<> {
        let wait = self.begin_wait(Some(time));
        async move { wait.await == Outcome::Notified }
    }

    fn begin_wait(&self, until: Option<Time>) -> Wait {
        Wait { handle: self.0.handle.clone(), signal: Some(self.clone()), until, ticket: None }
    }

    pub(crate) fn name(&self) -> Rc<str> {
        self.0.name.clone()
    }

    /// Adds a waiter, and forgets those that gave up: else waits that time out would pile up.
    pub(crate) fn enlist(&self, ticket: &Rc<Ticket>) {
        let mut waiters = self.0.waiters.borrow_mut();
        waiters.retain(|waiter| waiter.strong_count() > 0);
        waiters.push(Rc::downgrade(ticket));
    }
}
