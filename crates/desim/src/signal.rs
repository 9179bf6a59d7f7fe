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

/// Wakes the processes that wait for it. It has no memory: a notification reaches only the processes
/// that wait at that moment. Clones are the same signal.
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
            // Decided here and not when the event happens: a timer of the same time that is still in
            // the queue comes second.
            if tickets.end(waiter, Outcome::Notified) {
                self.state.schedule(self.state.now.get(), Event::Wake(waiter));
            }
        }
    }

    /// Waits for the next notification after the first poll.
    pub fn wait(&self) -> impl Future<Output = ()> + use<> {
        let wait = self.begin_wait(None);
        async move {
            wait.await;
        }
    }

    /// Waits for the next notification, at most until `time`: true if notified, false if `time`
    /// came first. A past time counts as the present.
    pub fn wait_until(&self, time: Time) -> impl Future<Output = bool> + use<> {
        let wait = self.begin_wait(Some(time));
        async move { wait.await == Outcome::Notified }
    }

    fn begin_wait(&self, until: Option<Time>) -> Wait {
        Wait::new(&self.state, Reason::Signal(Rc::clone(&self.waiters)), until)
    }
}
