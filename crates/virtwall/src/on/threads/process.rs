//! A process on a thread of its own.

use std::cell::RefCell;
use std::sync::mpsc::{Receiver, Sender};
use std::time::Instant;

use desim::{Duration, Time};
use radiosity::Work;

use crate::on::host::{Host, Meter, decode};
use crate::problem::Rank;
use crate::program::{Event, Process, ProgramError, Step};
use crate::wire::Message;

/// The bytes of a message, and its sender.
type Envelope = (Rank, Vec<u8>);

/// Ends a process that another one would wait for.
pub(super) fn end(to: &Sender<Envelope>) {
    // A process that has ended already does not receive.
    let _ = to.send((0, Message::Done.encode()));
}

/// A process on a thread of its own.
pub(super) struct ThreadProcess {
    rank: Rank,
    to: Vec<Sender<Envelope>>,
    from: Receiver<Envelope>,
    /// Arrived during a wait and not received yet.
    waiting: RefCell<Vec<Envelope>>,
    start: Instant,
    host: Host,
    pub meter: Meter,
}

impl ThreadProcess {
    pub fn new(
        rank: Rank,
        to: Vec<Sender<Envelope>>,
        from: Receiver<Envelope>,
        start: Instant,
        host: Host,
    ) -> ThreadProcess {
        let (waiting, meter) = (RefCell::default(), Meter::default());
        ThreadProcess { rank, to, from, waiting, start, host, meter }
    }

    /// Tell all processes that the run has ended, since this one cannot go on.
    pub fn end_all(&self) {
        self.to.iter().for_each(end);
    }
}

/// A process that panics sends no more: no other may wait for it.
impl Drop for ThreadProcess {
    fn drop(&mut self) {
        if std::thread::panicking() {
            self.end_all();
        }
    }
}

impl Process for ThreadProcess {
    fn rank(&self) -> Rank {
        self.rank
    }

    fn now(&self) -> Time {
        Time::ZERO + Duration::from_seconds_f64(self.start.elapsed().as_secs_f64())
    }

    async fn compute<T>(&self, _: Step<'_>, job: impl FnOnce() -> (T, Work)) -> T {
        let (result, work) = job();
        self.meter.work(work);
        result
    }

    async fn send(&self, to: Rank, message: Message) {
        // A receiver that has ended reads no more: after a premature end no process misses the message.
        let _ = self.to[to].send((self.rank, self.meter.encode(&message)));
    }

    async fn receive(&self) -> Result<Vec<(Rank, Message)>, ProgramError> {
        self.host.progress.check()?;
        let arrived = self.waiting.take().into_iter().chain(self.from.try_iter());
        arrived.map(|(from, bytes)| decode(self.rank, from, &bytes)).collect()
    }

    async fn wait(&self, until: Option<Time>) -> bool {
        if self.waiting.borrow().is_empty() {
            // A receive fails only when its time is over: this process holds a sender itself.
            let message = match until {
                None => self.from.recv().ok(),
                Some(until) => {
                    let left = (until - self.now().min(until)).as_seconds_f64();
                    self.from.recv_timeout(std::time::Duration::from_secs_f64(left)).ok()
                }
            };
            self.waiting.borrow_mut().extend(message);
        }
        !self.waiting.borrow().is_empty()
    }

    fn note(&self, event: Event<'_>) {
        self.host.note(&event);
    }
}
