//! What can happen at a moment of virtual time.

use std::rc::Rc;

use crate::repeated::Repeated;
use crate::ticket::{ProcessId, Ticket};

/// An event of a simulation.
pub(crate) enum Event {
    /// A process runs for the first time.
    Start(ProcessId),
    /// The time limit of a wait is reached.
    Timer(Ticket),
    /// A process resumes because a signal ended its wait.
    Wake(Ticket),
    /// A callback runs.
    Call(Box<dyn FnOnce()>),
    /// An alarm goes off, if it is still set for this time.
    Alarm(Rc<Repeated>),
}
