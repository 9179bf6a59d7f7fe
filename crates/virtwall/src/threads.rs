//! The same programs on real threads with channels: a reference for the simulation.

use std::cell::RefCell;
use std::future::Future;
use std::pin::pin;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::task::{Context, Poll, Waker};
use std::time::Instant;

use desim::{Duration, Time};
use multicomputer::Rank;
use radiosity::Work;

use crate::compute_node::compute_node;
use crate::message::Message;
use crate::outcome::{NodeReport, Outcome};
use crate::process::Process;
use crate::run::{Run, RunError};
use crate::service_node::service_node;

/// A process on a thread of its own.
struct ThreadProcess {
    rank: Rank,
    to: Vec<Sender<Vec<u8>>>,
    from: Receiver<Vec<u8>>,
    /// Received by a wait and not yet read.
    waiting: RefCell<Vec<Vec<u8>>>,
    start: Instant,
}

/// A process that panics sends no more: nobody is to wait for it.
impl Drop for ThreadProcess {
    fn drop(&mut self) {
        if std::thread::panicking() {
            // Those that have ended already need not hear of it.
            self.to.iter().for_each(|to| _ = to.send(Message::Done.encode()));
        }
    }
}

impl Process for ThreadProcess {
    fn rank(&self) -> Rank {
        self.rank
    }

    async fn compute<T>(&self, job: impl FnOnce() -> (T, Work)) -> T {
        job().0
    }

    async fn send(&self, to: Rank, message: Vec<u8>) {
        // A receiver that has ended reads no more: after a premature end nobody misses the message.
        let _ = self.to[to].send(message);
    }

    async fn received(&self) -> Vec<Vec<u8>> {
        let mut all = self.waiting.take();
        all.extend(self.from.try_iter());
        all
    }

    async fn wait(&self) {
        if self.waiting.borrow().is_empty() {
            // A receive fails only when all senders are gone, and this process holds one itself.
            self.waiting.borrow_mut().extend(self.from.recv());
        }
    }

    async fn wait_until(&self, time: Time) -> bool {
        if self.waiting.borrow().is_empty() {
            let left = (time - self.now().min(time)).as_seconds_f64();
            let message = self.from.recv_timeout(std::time::Duration::from_secs_f64(left));
            if message == Err(RecvTimeoutError::Timeout) {
                return false;
            }
            self.waiting.borrow_mut().extend(message);
        }
        true
    }

    fn now(&self) -> Time {
        Time::ZERO + Duration::from_seconds_f64(self.start.elapsed().as_secs_f64())
    }
}

/// Run on threads of this host, one a processor and one for the service node. The time of the
/// outcome is the host's; the light is the simulation's but for the order of messages.
pub fn run_on_threads(run: &Run) -> Result<Outcome, RunError> {
    let (nodes, collection) = run.prepare()?;
    let (to, from): (Vec<_>, Vec<_>) = (0..=nodes.len()).map(|_| channel()).unzip();
    #[expect(clippy::disallowed_methods, reason = "on threads time is the host's")]
    let start = Instant::now();
    let mut processes: Vec<ThreadProcess> = from
        .into_iter()
        .enumerate()
        .map(|(rank, from)| {
            let (to, waiting) = (to.clone(), RefCell::default());
            ThreadProcess { rank, to, from, waiting, start }
        })
        .collect();
    drop(to);
    let service = processes.pop();
    let finished = std::thread::scope(|scope| {
        if let Some(process) = service {
            scope.spawn(move || finish(service_node(&process, collection)));
        }
        let threads: Vec<_> = processes
            .into_iter()
            .zip(nodes)
            .map(|(process, node)| scope.spawn(move || finish(compute_node(&process, node))))
            .collect();
        let joined = threads.into_iter().map(|thread| thread.join().ok().flatten());
        // All are waited for, also after one that failed.
        joined.collect::<Vec<Option<_>>>()
    });
    let nodes: Option<Vec<_>> = finished.into_iter().collect();
    let nodes = nodes.ok_or(RunError::Thread)?;
    let time = Time::ZERO + Duration::from_seconds_f64(start.elapsed().as_secs_f64());
    let reports = vec![NodeReport::default(); nodes.len()];
    Ok(Outcome::of(time, &nodes, reports))
}

/// Run a program whose waits block its thread: it is done at the first poll.
fn finish<T>(program: impl Future<Output = T>) -> Option<T> {
    match pin!(program).poll(&mut Context::from_waker(Waker::noop())) {
        Poll::Ready(result) => Some(result),
        Poll::Pending => None,
    }
}
