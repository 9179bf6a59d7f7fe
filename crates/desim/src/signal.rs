//! Signals: how one process wakes others.

use std::cell::RefCell;
use std::future::Future;
use std::rc::Rc;

use crate::event::Event;
use crate::handle::Handle;
use crate::state::State;
use crate::ticket::{Outcome, Reason, Waiters};
use crate::time::Time;
use crate::wait::Wait;

/// A thing to wait for, without memory: a notification reaches those who wait at that moment, and
/// nobody else. Clones are the same signal.
#[derive(Clone)]
pub struct Signal {
    state: Rc<State>,
    waiters: Rc<Waiters>,
}

impl Signal {
    /// A new signal; `name` is what a [`crate::Stalled`] report calls it.
    pub fn new(handle: &Handle, name: impl Into<String>) -> Signal {
        let waiters = Waiters { name: name.into(), tickets: RefCell::default() };
        Signal { state: Rc::clone(&handle.0), waiters: Rc::new(waiters) }
    }

    /// Wakes every waiting process by an event at the present time, first come, first served.
    pub fn notify(&self) {
        let mut tickets = self.state.tickets.borrow_mut();
        for waiter in self.waiters.tickets.borrow_mut().drain(..) {
            // Decided here and not when the event comes: a timer of this very moment that is still
            // in the queue came second.
            if tickets.end(waiter, Outcome::Notified) {
                self.state.schedule(self.state.now.get(), Event::Wake(waiter));
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
        Wait::new(&self.state, Reason::Signal(Rc::clone(&self.waiters)), until)
    }
}
