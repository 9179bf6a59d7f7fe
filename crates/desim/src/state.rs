//! What a simulation shares with its handles, signals and waits.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use crate::event::{Event, EventQueue};
use crate::process::Process;
use crate::ticket::{ProcessId, Reason, Ticket};
use crate::time::Time;

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

/// The clock, the events to come and the processes.
#[derive(Default)]
pub(crate) struct State {
    pub(crate) now: Cell<Time>,
    pub(crate) queue: RefCell<EventQueue>,
    pub(crate) processes: RefCell<Vec<Process>>,
    /// The process that runs, none while a callback does.
    pub(crate) current: Cell<Option<ProcessId>>,
    pub(crate) observer: RefCell<Option<Observer>>,
}

impl State {
    /// Schedules an event, not earlier than now.
    pub(crate) fn schedule(&self, time: Time, event: Event) {
        self.queue.borrow_mut().schedule(time.max(self.now.get()), event);
    }

    /// A ticket for the process that runs now.
    ///
    /// # Panics
    /// When no process runs: a wait of this crate was polled by a foreign executor.
    pub(crate) fn issue_ticket(&self, on: Reason) -> Rc<Ticket> {
        let process = self.current.get();
        let process = process.expect("only processes of the simulation await its futures");
        let ticket = Rc::new(Ticket { process, on, outcome: Cell::default() });
        if let Some(process) = self.processes.borrow_mut().get_mut(process.0) {
            process.tickets.push(Rc::downgrade(&ticket));
        }
        ticket
    }
}
