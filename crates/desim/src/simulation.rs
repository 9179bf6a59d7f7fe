//! The executor: one thread of control that takes events in order and lets processes run.

use std::cell::{Cell, RefCell};
use std::rc::{Rc, Weak};
use std::task::{Context, Poll, Waker};

use crate::event::{Event, EventQueue};
use crate::handle::Handle;
use crate::process::{Process, ProcessId};
use crate::stalled::Stalled;
use crate::time::Time;
use crate::wait::{Outcome, Ticket};

/// What an observer is told of a process.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Observation {
    /// It runs for the first time.
    Started,
    /// It goes on because a signal came.
    Notified,
    /// It goes on because a time came.
    TimeCame,
    /// It has ended.
    Ended,
}

pub(crate) type Observer = Box<dyn FnMut(Time, &str, Observation)>;

/// What the simulation and its handles share.
#[derive(Default)]
pub(crate) struct Core {
    pub(crate) now: Cell<Time>,
    pub(crate) queue: RefCell<EventQueue>,
    pub(crate) processes: RefCell<Vec<Process>>,
    /// The process that runs, none while a callback does.
    pub(crate) current: Cell<Option<ProcessId>>,
    pub(crate) observer: RefCell<Option<Observer>>,
}

/// A simulation: processes, their events, and the clock.
#[derive(Default)]
pub struct Simulation {
    core: Rc<Core>,
}

impl Simulation {
    /// A simulation at time zero without processes.
    pub fn new() -> Simulation {
        Simulation::default()
    }

    /// What processes need to use the simulation.
    pub fn handle(&self) -> Handle {
        Handle(self.core.clone())
    }

    /// Takes events in order until none is left. Returns the time of the last one.
    ///
    /// # Errors
    /// [`Stalled`] when processes still wait then.
    pub fn run(&self) -> Result<Time, Stalled> {
        while let Some((time, event)) = self.core.next_event() {
            self.core.now.set(time);
            match event {
                Event::Start(process) => self.core.resume(process, Observation::Started),
                Event::Timer(ticket) => self.core.time_came(&ticket),
                Event::Wake(ticket) => self.core.wake(&ticket),
                Event::Call(action) => action(),
            }
        }
        let at = self.core.now.get();
        let waiting: Vec<_> =
            self.core.processes.borrow().iter().filter_map(Process::waiting).collect();
        if waiting.is_empty() { Ok(at) } else { Err(Stalled { at, waiting }) }
    }
}

impl Core {
    fn next_event(&self) -> Option<(Time, Event)> {
        self.queue.borrow_mut().next()
    }

    fn time_came(&self, ticket: &Weak<Ticket>) {
        if let Some(ticket) = ticket.upgrade() {
            ticket.outcome.set(Some(Outcome::TimeCame));
            self.resume(ticket.process, Observation::TimeCame);
        }
    }

    fn wake(&self, ticket: &Weak<Ticket>) {
        if let Some(ticket) = ticket.upgrade() {
            self.resume(ticket.process, Observation::Notified);
        }
    }

    /// Lets a process run until it waits again or ends.
    fn resume(&self, id: ProcessId, why: Observation) {
        let Some(mut body) = self.with_process(id, |process| {
            process.tickets.retain(|t| t.upgrade().is_some_and(|t| t.outcome.get().is_none()));
            process.body.take()
        }) else {
            return;
        };
        self.observe(id, why);
        self.current.set(Some(id));
        // No waker: every poll comes from an event.
        let state = body.as_mut().poll(&mut Context::from_waker(Waker::noop()));
        self.current.set(None);
        match state {
            Poll::Pending => _ = self.with_process(id, |process| process.body.replace(body)),
            Poll::Ready(()) => self.observe(id, Observation::Ended),
        }
    }

    fn with_process<T>(
        &self,
        id: ProcessId,
        action: impl FnOnce(&mut Process) -> Option<T>,
    ) -> Option<T> {
        action(self.processes.borrow_mut().get_mut(id.0)?)
    }

    fn observe(&self, id: ProcessId, what: Observation) {
        // Taken out for the call, so that an observer may itself set an observer.
        let Some(mut observer) = self.observer.take() else { return };
        let name = self.processes.borrow()[id.0].name.clone();
        observer(self.now.get(), &name, what);
        self.observer.borrow_mut().get_or_insert(observer);
    }
}

impl Drop for Simulation {
    /// Processes and callbacks hold handles to the core that holds them: breaks these circles.
    fn drop(&mut self) {
        let queue = self.core.queue.take();
        let processes = self.core.processes.take();
        let observer = self.core.observer.take();
        // Dropped only now that nothing is borrowed: a body's own destructors may use a handle.
        drop((queue, processes, observer));
    }
}
