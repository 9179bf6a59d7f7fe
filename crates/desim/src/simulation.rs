//! The executor: takes events in order and runs processes, on one thread.

use std::rc::Rc;
use std::task::{Context, Poll, Waker};

use crate::event::Event;
use crate::handle::Handle;
use crate::process::Process;
use crate::stalled::Stalled;
use crate::state::{Observation, State};
use crate::ticket::{Outcome, ProcessId, Ticket};
use crate::time::Time;

/// A simulation: processes, their events, and the clock.
#[derive(Default)]
pub struct Simulation {
    state: Rc<State>,
}

impl Simulation {
    /// A simulation at time zero without processes.
    pub fn new() -> Simulation {
        Simulation::default()
    }

    /// The interface that processes use.
    pub fn handle(&self) -> Handle {
        Handle(self.state.clone())
    }

    /// Takes events in order until none is left. Returns the time of the last one.
    ///
    /// # Errors
    /// [`Stalled`] if processes still wait then, or if the run was halted.
    pub fn run(&self) -> Result<Time, Stalled> {
        while let Some((time, event)) = self.next_event() {
            if self.state.is_stale(time, &event) {
                continue;
            }
            self.state.now.set(time);
            match event {
                Event::Start(process) => self.resume(process, Observation::Started),
                Event::Timer(ticket) => self.time_came(ticket),
                Event::Wake(ticket) => self.wake(ticket),
                Event::Call(action) => action(),
                Event::Alarm(alarm) => alarm.call(),
            }
            if self.state.is_halted.get() {
                break;
            }
        }
        let at = self.state.now.get();
        self.state.is_halted.set(false);
        let (waiting, cause) = (self.state.waiting(), self.state.halted.take());
        match waiting.is_empty() && cause.is_none() {
            true => Ok(at),
            false => Err(Stalled { at, cause, waiting }),
        }
    }

    fn next_event(&self) -> Option<(Time, Event)> {
        self.state.queue.borrow_mut().take()
    }

    fn time_came(&self, ticket: Ticket) {
        let process = {
            let mut tickets = self.state.tickets.borrow_mut();
            tickets.end(ticket, Outcome::TimeCame);
            tickets.process(ticket)
        };
        self.resume(process, Observation::TimeCame);
    }

    fn wake(&self, ticket: Ticket) {
        let process = self.state.tickets.borrow().process(ticket);
        self.resume(process, Observation::Notified);
    }

    /// Runs a process until it waits again or ends.
    fn resume(&self, id: ProcessId, why: Observation) {
        let Some(mut body) = self.with_process(id, |process| process.body.take()) else {
            return;
        };
        self.observe(id, why);
        self.state.current.set(Some(id));
        // No waker: every poll comes from an event.
        let progress = body.as_mut().poll(&mut Context::from_waker(Waker::noop()));
        self.state.current.set(None);
        match progress {
            Poll::Pending => _ = self.with_process(id, |process| process.body.replace(body)),
            Poll::Ready(()) => self.observe(id, Observation::Ended),
        }
    }

    fn with_process<T>(
        &self,
        id: ProcessId,
        action: impl FnOnce(&mut Process) -> Option<T>,
    ) -> Option<T> {
        action(self.state.processes.borrow_mut().get_mut(id.0)?)
    }

    fn observe(&self, id: ProcessId, what: Observation) {
        // Taken out for the call, so that an observer may itself set an observer.
        let Some(mut observer) = self.state.observer.take() else { return };
        let name = self.state.processes.borrow()[id.0].name.clone();
        observer(self.state.now.get(), &name, what);
        self.state.observer.borrow_mut().get_or_insert(observer);
    }
}

impl Drop for Simulation {
    /// Breaks reference cycles: processes and callbacks hold handles to the state that holds them.
    fn drop(&mut self) {
        let queue = self.state.queue.take();
        let processes = self.state.processes.take();
        let observer = self.state.observer.take();
        // Dropped when nothing is borrowed: a destructor in a process may use a handle.
        drop((queue, processes, observer));
    }
}
