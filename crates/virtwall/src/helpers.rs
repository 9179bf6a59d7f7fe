//! Threads of the host that have nothing else to do, and the work that they may do ahead of its time.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

/// Work that changes nothing but how soon its result is there.
type Job = Box<dyn FnOnce() + Send>;

/// Threads that do their own work first; one that has none left helps the others, until all have done
/// theirs.
#[derive(Default)]
pub struct Helpers {
    state: Mutex<State>,
    changed: Condvar,
    /// Threads that help.
    helping: AtomicUsize,
}

#[derive(Default)]
struct State {
    jobs: VecDeque<Job>,
    /// Threads with work of their own.
    working: usize,
}

impl Helpers {
    /// So many threads, each of which calls [`Helpers::work_then_help`], once.
    pub fn of(threads: usize) -> Helpers {
        Helpers {
            state: Mutex::new(State { jobs: VecDeque::new(), working: threads }),
            ..Helpers::default()
        }
    }

    /// Do the work of this thread, then help the others until theirs is done.
    pub fn work_then_help<T>(&self, work: impl FnOnce() -> T) -> T {
        let done = {
            let _working = Working(self);
            work()
        };
        self.helping.fetch_add(1, Ordering::Relaxed);
        while let Some(job) = self.wait() {
            job();
        }
        self.helping.fetch_sub(1, Ordering::Relaxed);
        done
    }

    /// Whether anybody helps.
    pub(crate) fn any(&self) -> bool {
        self.helping.load(Ordering::Relaxed) > 0
    }

    /// Put a job up for whoever helps.
    pub(crate) fn add(&self, job: Job) {
        self.held().jobs.push_back(job);
        self.changed.notify_one();
    }

    /// A job that waits: the oldest, since it is likely to be needed first.
    pub(crate) fn take(&self) -> Option<Job> {
        self.held().jobs.pop_front()
    }

    /// The next job; none when all threads help.
    fn wait(&self) -> Option<Job> {
        let mut state = self.held();
        while state.working > 0 {
            let job = state.jobs.pop_front();
            if job.is_some() {
                return job;
            }
            state = self.changed.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
        None
    }

    fn held(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A thread at its own work; also if it panics, that ends.
struct Working<'a>(&'a Helpers);

impl Drop for Working<'_> {
    fn drop(&mut self) {
        self.0.held().working -= 1;
        self.0.changed.notify_all();
    }
}
