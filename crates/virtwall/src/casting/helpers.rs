//! Idle threads of the host, and jobs that they may do ahead of time.

use std::collections::VecDeque;
use std::mem;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use super::waiters::Waiters;

/// Work that changes no result, only how soon it is available.
type Job = Box<dyn FnOnce() + Send>;

/// Largest number of waiting jobs, of about 4 KB each.
const MOST_JOBS: usize = 1_024;

/// A group of threads. Each does its own work first, then helps the others until all are done.
#[derive(Default)]
pub struct Helpers {
    state: Mutex<State>,
    changed: Waiters,
    /// All threads.
    threads: AtomicUsize,
}

#[derive(Default)]
struct State {
    jobs: VecDeque<Job>,
    /// Threads with work of their own.
    working: usize,
}

impl Helpers {
    /// A group of `threads`, each of which calls [`Helpers::work_then_help`] once.
    pub fn of(threads: usize) -> Helpers {
        Helpers {
            state: Mutex::new(State { working: threads, ..State::default() }),
            changed: Waiters::default(),
            threads: AtomicUsize::new(threads),
        }
    }

    /// Says that `count` threads of the group could not be started.
    pub fn without(&self, count: usize) {
        self.threads.fetch_sub(count, Ordering::Relaxed);
        (0..count).for_each(|_| drop(Working(self)));
    }

    /// Do the work of this thread, then help the others until theirs is done.
    pub fn work_then_help<T>(&self, work: impl FnOnce() -> T) -> T {
        let done = {
            let _working = Working(self);
            work()
        };
        while let Some(job) = self.wait() {
            job();
        }
        // Jobs that were not done hold references to their data.
        let rest = mem::take(&mut self.held().jobs);
        drop(rest);
        done
    }

    /// Whether other threads may help, and the list of jobs has room.
    pub(crate) fn want_jobs(&self) -> bool {
        self.threads.load(Ordering::Relaxed) > 1 && self.held().jobs.len() < MOST_JOBS
    }

    /// Add a job for an idle thread.
    pub(crate) fn add(&self, job: Job) {
        self.held().jobs.push_back(job);
        self.changed.notify_one();
    }

    /// The oldest job that waits: it is likely to be needed first.
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
            state = self.changed.wait(state);
        }
        None
    }

    fn held(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Marks a thread as doing its own work, until dropped, also by a panic.
struct Working<'a>(&'a Helpers);

impl Drop for Working<'_> {
    fn drop(&mut self) {
        let mut state = self.0.held();
        state.working = state.working.saturating_sub(1);
        drop(state);
        self.0.changed.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use std::panic::{AssertUnwindSafe, catch_unwind};
    use std::sync::Arc;
    use std::thread;

    use super::*;

    /// Jobs that one thread adds are done by the others.
    #[test]
    fn others_help() {
        let helpers = Helpers::of(3);
        let done = Arc::new(AtomicUsize::new(0));
        thread::scope(|scope| {
            for _ in 0..2 {
                scope.spawn(|| helpers.work_then_help(|| ()));
            }
            helpers.work_then_help(|| {
                for _ in 0..100 {
                    let done = Arc::clone(&done);
                    helpers.add(Box::new(move || _ = done.fetch_add(1, Ordering::Relaxed)));
                }
                while done.load(Ordering::Relaxed) < 100 {
                    thread::yield_now();
                }
            });
        });
    }

    /// No thread waits for one that panicked.
    #[test]
    fn a_panic_ends_the_work() {
        let helpers = Helpers::of(2);
        thread::scope(|scope| {
            let helping = scope.spawn(|| helpers.work_then_help(|| ()));
            let panics = AssertUnwindSafe(|| helpers.work_then_help(|| panic!("as it should")));
            assert!(catch_unwind(panics).is_err());
            helping.join().unwrap();
        });
    }

    /// No thread waits for one that could not be started.
    #[test]
    fn a_group_may_be_smaller_than_planned() {
        let helpers = Helpers::of(3);
        thread::scope(|scope| {
            let helping = scope.spawn(|| helpers.work_then_help(|| ()));
            helpers.without(1);
            helpers.work_then_help(|| ());
            helping.join().unwrap();
        });
        assert!(Helpers::of(2).want_jobs());
        let alone = Helpers::of(2);
        alone.without(1);
        assert!(!alone.want_jobs());
    }

    /// Jobs hold references, which may include one to the helpers.
    #[test]
    fn jobs_left_over_are_let_go() {
        let (helpers, held) = (Helpers::of(1), Arc::new(()));
        let job = Arc::clone(&held);
        helpers.add(Box::new(move || drop(job)));
        helpers.work_then_help(|| ());
        assert_eq!(Arc::strong_count(&held), 1);
    }
}
