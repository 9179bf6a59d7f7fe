//! The executor: takes events in order and runs processes, on one thread.

use std::rc::Rc;
use std::task::{Context, Waker};

use crate::event::Event;
use crate::handle::Handle;
use crate::stalled::Stalled;
use crate::state::State;
use crate::ticket::{Outcome, ProcessId, Ticket};
use crate::time::Time;

/// Times saturate. So the last one stands for every time that is too late or not a number.
const TIME_IS_OVER: &str =
    "an event is later than virtual time lasts (213 days), or its time is not a number";

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
    /// [`Stalled`] if processes still wait then, if the run was halted, or if an event is at [`Time::MAX`].
    pub fn run(&self) -> Result<Time, Stalled> {
        loop {
            let next = self.state.queue.borrow_mut().take();
            let Some((time, event)) = next else { break };
            if self.state.is_stale(time, &event) {
                continue;
            }
            if time == Time::MAX {
                self.handle().halt(TIME_IS_OVER);
                break;
            }
            self.state.now.set(time);
            match event {
                Event::Start(process) => self.resume(process),
                Event::Timer(ticket) => {
                    self.state.tickets.borrow_mut().end(ticket, Outcome::TimeCame);
                    self.resume(self.process(ticket));
                }
                Event::Wake(ticket) => self.resume(self.process(ticket)),
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

    fn process(&self, ticket: Ticket) -> ProcessId {
        self.state.tickets.borrow().process(ticket)
    }

    /// Runs a process until it waits again or ends.
    fn resume(&self, id: ProcessId) {
        let body = self.state.processes.borrow_mut()[id.0].body.take();
        let Some(mut body) = body else { return };
        self.state.current.set(Some(id));
        // No waker: every poll comes from an event.
        let progress = body.as_mut().poll(&mut Context::from_waker(Waker::noop()));
        self.state.current.set(None);
        if progress.is_pending() {
            self.state.processes.borrow_mut()[id.0].body = Some(body);
        }
    }
}

impl Drop for Simulation {
    /// Breaks reference cycles: processes and callbacks hold handles to the state that holds them.
    fn drop(&mut self) {
        let queue = self.state.queue.take();
        let processes = self.state.processes.take();
        // Dropped when nothing is borrowed: a destructor in a process may use a handle.
        drop((queue, processes));
    }
}
