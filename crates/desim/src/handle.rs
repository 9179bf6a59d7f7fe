//! What processes and callbacks may ask of the simulation.

use std::future::Future;
use std::rc::Rc;

use crate::event::Event;
use crate::process::Process;
use crate::state::{Observation, State};
use crate::ticket::{ProcessId, Reason};
use crate::time::{Duration, Time};
use crate::wait::Wait;

/// Access to a running simulation; cheap to clone and to move into a process.
#[derive(Clone)]
pub struct Handle(pub(crate) Rc<State>);

impl Handle {
    /// The present virtual time.
    pub fn now(&self) -> Time {
        self.0.now.get()
    }

    /// Creates a process; an event at the present time starts it. Only the waits of this crate
    /// resume it: there is no waker behind any other future.
    pub fn spawn(
        &self,
        name: impl Into<String>,
        future: impl Future<Output = ()> + 'static,
    ) -> ProcessId {
        let mut processes = self.0.processes.borrow_mut();
        let id = ProcessId(processes.len());
        let name = name.into().into();
        processes.push(Process { name, body: Some(Box::pin(future)) });
        self.0.schedule(self.now(), Event::Start(id));
        id
    }

    /// Waits for a span that begins with this call. A span of zero still lets the other events of
    /// the moment that are due before it go first.
    pub fn sleep(&self, span: Duration) -> impl Future<Output = ()> + use<> {
        self.sleep_until(self.now() + span)
    }

    /// Waits until a moment; one that is past counts as the present.
    pub fn sleep_until(&self, time: Time) -> impl Future<Output = ()> + use<> {
        let wait = Wait::new(&self.0, Reason::Time(time), Some(time));
        async move {
            wait.await;
        }
    }

    /// Calls `action` at a moment; one that is past counts as the present. The call is an event of
    /// its own, never made from within `at`.
    pub fn at(&self, time: Time, action: impl FnOnce() + 'static) {
        self.0.schedule(time, Event::Call(Box::new(action)));
    }

    /// Ends the run once the present event is over, as stalled for the reason given: what the
    /// processes wait for can never come, though other events may be left.
    pub fn halt(&self, cause: impl Into<String>) {
        self.0.halted.borrow_mut().get_or_insert(cause.into());
        self.0.is_halted.set(true);
    }

    /// Has every step of every process reported, as (time, process, what happened), to `observer`,
    /// in place of an earlier observer.
    pub fn set_observer(&self, observer: impl FnMut(Time, &str, Observation) + 'static) {
        *self.0.observer.borrow_mut() = Some(Box::new(observer));
    }
}
