//! A message coprocessor: a second processor that sends and receives.

use std::collections::VecDeque;

use super::envelope::Envelope;

/// Handles one message at a time, first come, first served.
pub(crate) struct Coprocessor<M> {
    jobs: VecDeque<Job<M>>,
    busy: bool,
}

/// Work for a coprocessor.
pub(crate) enum Job<M> {
    /// Sends a message.
    Send(Envelope<M>),
    /// Receives a message of this length.
    Receive(u64, M),
}

impl<M> Coprocessor<M> {
    /// A coprocessor without work.
    pub(crate) fn new() -> Coprocessor<M> {
        Coprocessor { jobs: VecDeque::new(), busy: false }
    }

    /// Adds a job. Returns whether the coprocessor is idle, and has to be started.
    pub(crate) fn push(&mut self, job: Job<M>) -> bool {
        self.jobs.push_back(job);
        !self.busy
    }

    /// Starts the next job, or becomes idle.
    pub(crate) fn start_next(&mut self) -> Option<Job<M>> {
        let job = self.jobs.pop_front();
        self.busy = job.is_some();
        job
    }
}
