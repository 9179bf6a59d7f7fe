//! The state that a simulation shares with its handles, signals and waits.

use std::cell::{Cell, RefCell};

use crate::event::Event;
use crate::event_queue::EventQueue;
use crate::process::Process;
use crate::stalled::Waiting;
use crate::ticket::{ProcessId, Reason, Ticket, Tickets};
use crate::time::Time;

/// The clock, the events to come and the processes.
#[derive(Default)]
pub(crate) struct State {
    pub(crate) now: Cell<Time>,
    pub(crate) queue: RefCell<EventQueue<Event>>,
    pub(crate) processes: RefCell<Vec<Process>>,
    pub(crate) tickets: RefCell<Tickets>,
    /// Why the run must end after the present event; none if it need not.
    pub(crate) halted: RefCell<Option<String>>,
    pub(crate) is_halted: Cell<bool>,
    /// The process that runs; none during a callback.
    pub(crate) current: Cell<Option<ProcessId>>,
}

impl State {
    /// Schedules an event, not earlier than now.
    #[inline]
    pub(crate) fn schedule(&self, time: Time, event: Event) {
        self.queue.borrow_mut().schedule(time.max(self.now.get()), event);
    }

    /// A ticket for the process that runs now.
    ///
    /// # Panics
    /// When no process runs: a wait of this crate was polled by a foreign executor.
    #[inline]
    pub(crate) fn issue_ticket(&self, on: Reason) -> Ticket {
        let process = self.current.get();
        let process = process.expect("only processes of the simulation await its futures");
        self.tickets.borrow_mut().issue(process, on)
    }

    /// Whether an event is obsolete: its wait was dropped, a signal ended the wait earlier, or the
    /// alarm was set for another time. Such an event must not move the clock.
    #[inline]
    pub(crate) fn is_stale(&self, time: Time, event: &Event) -> bool {
        match event {
            Event::Start(_) | Event::Call(_) => false,
            Event::Timer(ticket) => !self.tickets.borrow().is_open(*ticket),
            Event::Wake(ticket) => !self.tickets.borrow().is_held(*ticket),
            Event::Alarm(alarm) => !alarm.is_due(time),
        }
    }

    /// The processes that have not ended, and what each waits for.
    pub(crate) fn waiting(&self) -> Vec<Waiting> {
        let (processes, tickets) = (self.processes.borrow(), self.tickets.borrow());
        let left = processes.iter().enumerate().filter(|(_, process)| process.body.is_some());
        left.map(|(id, process)| {
            let reasons: Vec<String> =
                tickets.reasons(ProcessId(id)).map(ToString::to_string).collect();
            let on = match reasons.is_empty() {
                true => "a future that no event resolves".to_owned(),
                false => reasons.join(" or "),
            };
            Waiting { process: process.name.clone(), on }
        })
        .collect()
    }
}
