//! A process: a named future that only events resume.

use std::future::Future;
use std::pin::Pin;
use std::rc::{Rc, Weak};

use crate::stalled::Waiting;
use crate::ticket::Ticket;

/// The body of a process.
pub(crate) type Body = Pin<Box<dyn Future<Output = ()>>>;

pub(crate) struct Process {
    pub(crate) name: Rc<str>,
    /// `None` while the process runs, and once it has ended.
    pub(crate) body: Option<Body>,
    /// What the process waits for: one ticket for most, several if it awaits several futures.
    pub(crate) tickets: Vec<Weak<Ticket>>,
}

impl Process {
    /// Who waits for what, if the process has not ended.
    pub(crate) fn waiting(&self) -> Option<Waiting> {
        self.body.as_ref()?;
        let reasons: Vec<String> = self
            .tickets
            .iter()
            .filter_map(Weak::upgrade)
            .filter(|ticket| ticket.outcome.get().is_none())
            .map(|ticket| ticket.on.to_string())
            .collect();
        let on = if reasons.is_empty() {
            "a future that no event resolves".to_owned()
        } else {
            reasons.join(" or ")
        };
        Some(Waiting { process: self.name.to_string(), on })
    }
}
