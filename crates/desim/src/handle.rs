//! The interface of a running simulation for processes and callbacks.

use std::future::Future;
use std::rc::Rc;

use crate::event::Event;
use crate::process::Process;
use crate::state::State;
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

    /// Creates a process, which an event at the present time starts. Only the waits of this crate
    /// resume it: no other future has a waker.
    pub fn spawn(&self, name: impl Into<String>, future: impl Future<Output = ()> + 'static) {
        let mut processes = self.0.processes.borrow_mut();
        let id = ProcessId(processes.len());
        processes.push(Process { name: name.into(), body: Some(Box::pin(future)) });
        self.0.schedule(self.now(), Event::Start(id));
    }

    /// Waits for a span that begins with this call. With a span of zero, the events already
    /// scheduled for the present time still happen first.
    pub fn sleep(&self, span: Duration) -> impl Future<Output = ()> + use<> {
        self.sleep_until(self.now() + span)
    }

    /// Waits until `time`. A past time counts as the present.
    pub fn sleep_until(&self, time: Time) -> impl Future<Output = ()> + use<> {
        let wait = Wait::new(&self.0, Reason::Time(time), Some(time));
        async move {
            wait.await;
        }
    }

    /// Calls `action` at `time`. A past time counts as the present. The call is an event of its
    /// own, never made from within `at`.
    pub fn at(&self, time: Time, action: impl FnOnce() + 'static) {
        self.0.schedule(time, Event::Call(Box::new(action)));
    }

    /// Ends the run after the present event, as stalled for the cause given: what processes wait
    /// for can never happen, though other events may be left.
    pub fn halt(&self, cause: impl Into<String>) {
        self.0.halted.borrow_mut().get_or_insert(cause.into());
        self.0.is_halted.set(true);
    }
}
